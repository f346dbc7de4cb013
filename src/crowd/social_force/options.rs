use serde::{Deserialize, Serialize};

use crate::crowd::CrowdError;

/// Sizes and forces of groups that walk together, under social forces.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct GroupOptions {
    /// Shares of groups of one, two, three and four people. Together more than 0; only their proportions count.
    pub shares: [f64; 4],
    /// Fall of a group's free speed with each further member, metres per second.
    pub slowdown: f64,
    /// Strength of the wish to have the others in view (beta 1), per second and radian of the head's turn.
    pub gaze: f64,
    /// Pull towards the group's middle beyond `reach` (beta 2), metres per second squared.
    pub cohesion: f64,
    /// Push away from members nearer than `distance` (beta 3), metres per second squared.
    pub repulsion: f64,
    /// Distance below which members push each other away (d0), metres.
    pub distance: f64,
    /// Field of view to either side without turning the head (phi), degrees.
    pub view_deg: f64,
    /// Distance from the group's middle, per further member, beyond which a member is pulled back, metres.
    pub reach: f64,
}

impl Default for GroupOptions {
    /// Moussaid, Perozo, Garnier, Helbing, Theraulaz 2010 (doi 10.1371/journal.pone.0010047).
    ///
    /// Published (fig. 4, calibrated there): beta 1 = 4, beta 2 = 3, beta 3 = 1, d0 = 0.8 m, phi = 90 degrees. Published
    /// (fig. 1): group sizes follow a Poisson distribution without its zero; the shares here are that with the parameter
    /// 0.83, to be treated as approximate, cut off behind four. Ours: the reach. The paper's is about 0.5 m; with 0.4 m,
    /// half of d0, pairs walk 0.8 m apart, as they were observed to. Ours: no slowdown. Waiting for each other makes groups
    /// about as slow as in fig. 2 (published: `1.26 - 0.04 n` m/s for `n` people at low density).
    fn default() -> GroupOptions {
        GroupOptions {
            shares: [0.642, 0.266, 0.074, 0.015],
            slowdown: 0.0,
            gaze: 4.0,
            cohesion: 3.0,
            repulsion: 1.0,
            distance: 0.8,
            view_deg: 90.0,
            reach: 0.4,
        }
    }
}

/// Parameters of the social forces: how people push each other by their mere presence.
///
/// Moussaid, Helbing, Garnier, Johansson, Combe, Theraulaz 2009 (doi 10.1098/rspb.2009.0405): with
/// `D = lambda (v_i - v_j) + e_ij`, `t = D / |D|`, `n` to the left of `t`, `theta` the angle from `t` to `e_ij`,
/// `B = gamma |D|` and the distance `d`,
///
/// ```text
/// f_v     = -A exp(-d / B - (n' B theta)^2)                 along t: slowing down
/// f_theta = -A sign(theta) exp(-d / B - (n B theta)^2)      along n: stepping aside
/// f_wall  =  a exp(-d_wall / b)                             away from the nearest wall
/// ```
///
/// Published there: A = 4.5 m/s², gamma = 0.35, lambda = 2, n = 2, n' = 3, tau = 0.54 s. The same paper's for walls, to be
/// treated as approximate: a = 3 m/s², b = 0.1 m. That nobody walks faster than 1.3 times their own speed is of Helbing and
/// Molnar 1995 (doi 10.1103/PhysRevE.51.4282). Ours: `behind`, which takes the paper's two people who face each other to
/// crowds, and `fluctuation`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SocialForceOptions {
    /// Time in which the desired velocity is taken up (tau), seconds.
    pub relaxation: f64,
    /// Strength of the interaction (A), metres per second squared.
    pub strength: f64,
    /// Range of the interaction for each unit of `|D|` (gamma), metres.
    pub range: f64,
    /// Weight of velocity against place in the direction of the interaction (lambda), seconds.
    pub foresight: f64,
    /// Angular narrowness of stepping aside (n).
    pub aside_width: f64,
    /// Angular narrowness of slowing down (n').
    pub slowing_width: f64,
    /// Weight of people straight behind against people straight ahead, 0 to 1.
    pub behind: f64,
    /// Push of a wall that the body touches (a), metres per second squared.
    pub wall_strength: f64,
    /// Distance over which the push of a wall falls to 1/e (b), metres.
    pub wall_range: f64,
    /// Standard deviation of a random acceleration along each axis, metres per second squared.
    pub fluctuation: f64,
    /// Largest speed as a multiple of a person's free speed.
    pub most_speed: f64,
}

impl Default for SocialForceOptions {
    fn default() -> SocialForceOptions {
        SocialForceOptions {
            relaxation: 0.54,
            strength: 4.5,
            range: 0.35,
            foresight: 2.0,
            aside_width: 2.0,
            slowing_width: 3.0,
            behind: 0.06,
            wall_strength: 3.0,
            wall_range: 0.1,
            fluctuation: 0.3,
            most_speed: 1.3,
        }
    }
}

/// Name and value of a number, and the range that it has to be in.
type Checked = (&'static str, f64, f64, f64);

fn check(numbers: &[Checked]) -> Result<(), CrowdError> {
    match numbers.iter().find(|(_, value, low, high)| !(*low..=*high).contains(value)) {
        Some(&(name, value, low, high)) => Err(CrowdError::Number { name, value, low, high }),
        None => Ok(()),
    }
}

impl GroupOptions {
    pub(in crate::crowd) fn check(&self) -> Result<(), CrowdError> {
        for share in self.shares {
            check(&[("groups.shares", share, 0.0, 1e6)])?;
        }
        check(&[
            ("groups.shares together", self.shares.iter().sum(), 1e-9, 4e6),
            ("groups.slowdown", self.slowdown, 0.0, 0.5),
            ("groups.gaze", self.gaze, 0.0, 20.0),
            ("groups.cohesion", self.cohesion, 0.0, 20.0),
            ("groups.repulsion", self.repulsion, 0.0, 20.0),
            ("groups.distance", self.distance, 0.2, 3.0),
            ("groups.view_deg", self.view_deg, 10.0, 180.0),
            ("groups.reach", self.reach, 0.1, 3.0),
        ])
    }
}

impl SocialForceOptions {
    pub(in crate::crowd) fn check(&self) -> Result<(), CrowdError> {
        check(&[
            ("social_force.relaxation", self.relaxation, 0.1, 5.0),
            ("social_force.strength", self.strength, 0.0, 50.0),
            ("social_force.range", self.range, 0.05, 2.0),
            ("social_force.foresight", self.foresight, 0.0, 10.0),
            ("social_force.aside_width", self.aside_width, 0.0, 20.0),
            ("social_force.slowing_width", self.slowing_width, 0.0, 20.0),
            ("social_force.behind", self.behind, 0.0, 1.0),
            ("social_force.wall_strength", self.wall_strength, 0.0, 50.0),
            ("social_force.wall_range", self.wall_range, 0.01, 2.0),
            ("social_force.fluctuation", self.fluctuation, 0.0, 3.0),
            ("social_force.most_speed", self.most_speed, 1.0, 2.0),
        ])
    }
}
