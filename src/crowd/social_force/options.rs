use crate::options::options;

options! {
    /// Sizes and forces of groups that walk together, under social forces.
    ///
    /// Moussaid, Perozo, Garnier, Helbing, Theraulaz 2010 (doi 10.1371/journal.pone.0010047).
    ///
    /// Published (fig. 4, calibrated there): beta 1 = 4, beta 2 = 3, beta 3 = 1, d0 = 0.8 m, phi = 90 degrees. Published
    /// (fig. 1): group sizes follow a Poisson distribution without its zero; the shares here are that with the parameter
    /// 0.83, to be treated as approximate, cut off behind four. Ours: the reach. The paper's is about 0.5 m; with 0.4 m,
    /// half of d0, pairs walk 0.8 m apart, as they were observed to. Ours: no slowdown. Waiting for each other makes groups
    /// about as slow as in fig. 2 (published: `1.26 - 0.04 n` m/s for `n` people at low density).
    pub struct GroupOptions {
        /// Social-force: of all groups, which share has 1, 2, 3 and 4 people.
        ///
        /// Together more than 0; only their proportions count.
        shares: [f64; 4] = [0.642, 0.266, 0.074, 0.015], in 0.0..=1e6;
        /// How much more slowly each further member wants to walk.
        slowdown: f64 = 0.0, in 0.0..=0.5, unit "m/s";
        /// Strength of the wish to have the others in view.
        ///
        /// Strength of the wish to have the others in view (beta 1), per second and radian of the head's turn.
        gaze: f64 = 4.0, in 0.0..=20.0, unit "per s and radian";
        /// Pull towards the group's middle for who is far from it.
        ///
        /// Pull towards the group's middle beyond `reach` (beta 2), metres per second squared.
        cohesion: f64 = 3.0, in 0.0..=20.0, unit "m/s2";
        /// Push away from members who are too near.
        ///
        /// Push away from members nearer than `distance` (beta 3), metres per second squared.
        repulsion: f64 = 1.0, in 0.0..=20.0, unit "m/s2";
        /// What is too near.
        ///
        /// Distance below which members push each other away (d0), metres.
        distance: f64 = 0.8, in 0.2..=3.0, unit "m";
        /// How far to either side people see with the head straight.
        ///
        /// Field of view to either side without turning the head (phi), degrees.
        view_deg: f64 = 90.0, in 10.0..=180.0, unit "degrees";
        /// What is far from the middle, per further member.
        reach: f64 = 0.4, in 0.1..=3.0, unit "m";
    }
}

options! {
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
    pub struct SocialForceOptions {
        /// Social-force: how long it takes to walk as one wants.
        ///
        /// Time in which the desired velocity is taken up (tau), seconds.
        relaxation: f64 = 0.54, in 0.1..=5.0, unit "s";
        /// How hard others push.
        ///
        /// Strength of the interaction (A), metres per second squared.
        strength: f64 = 4.5, in 0.0..=50.0, unit "m/s2";
        /// How far, for those who keep their distance.
        ///
        /// Range of the interaction for each unit of `|D|` (gamma), metres.
        range: f64 = 0.35, in 0.05..=2.0, unit "m";
        /// How much more those count who come nearer.
        ///
        /// Weight of velocity against place in the direction of the interaction (lambda), seconds.
        foresight: f64 = 2.0, in 0.0..=10.0, unit "s";
        /// How narrowly ahead others make one step aside.
        ///
        /// Angular narrowness of stepping aside (n).
        aside_width: f64 = 2.0, in 0.0..=20.0, unit "per m and radian";
        /// How narrowly ahead others slow one down.
        ///
        /// Angular narrowness of slowing down (n').
        slowing_width: f64 = 3.0, in 0.0..=20.0, unit "per m and radian";
        /// What somebody behind counts against somebody ahead.
        behind: f64 = 0.06, in 0.0..=1.0;
        /// How hard a wall pushes that is touched.
        ///
        /// Push of a wall that the body touches (a), metres per second squared.
        wall_strength: f64 = 3.0, in 0.0..=50.0, unit "m/s2";
        /// Over which distance that falls to 1/e.
        ///
        /// Distance over which the push of a wall falls to 1/e (b), metres.
        wall_range: f64 = 0.1, in 0.01..=2.0, unit "m";
        /// How unevenly people walk of themselves: deviation.
        fluctuation: f64 = 0.3, in 0.0..=3.0, unit "m/s2";
        /// Nobody walks faster than so many times their own speed.
        most_speed: f64 = 1.3, in 1.0..=2.0;
    }
}
