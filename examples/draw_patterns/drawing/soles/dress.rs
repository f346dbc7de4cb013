//! Leather soles: what is worn to the office.

use trodden::math::vec2;

use super::super::foot::{Last, Site};
use super::super::shape::{bars, block, border, both, disc, hexagonal_cell, smoothstep, union, without};
use super::{Sole, behind};

/// Stitches: dots along the line that runs `inset` within the edge.
fn stitches(site: &Site, inset: f64, pitch: f64) -> f64 {
    // Along the edge x serves as arc length, but for the round of the toe, where y does.
    let round = smoothstep(0.86, 0.93, site.along) > 0.5;
    let run = if round { site.p.y } else { site.p.x };
    let gap = (run - pitch * (run / pitch).round()).abs();
    vec2((site.inset - inset) * 1.4, gap).length() - 0.09
}

/// An oxford with a leather sole: smooth forepart with the stitched seam, bare waist, heel with a straight front
/// edge, a rubber corner and nails.
pub fn leather_shoe() -> Sole {
    fn tread(site: &Site) -> f64 {
        let p = site.p;
        let seam = stitches(site, 0.5, 0.38);
        let forepart = without(both(-site.inset, -behind(p, 15.2, 0.10)), seam);
        let corner = (p.y - 0.55 * p.x + 0.2).abs() - 0.06;
        let nails = disc(vec2(p.x - 4.6, p.y.abs() - 1.3), 0.11)
            .min(disc(vec2(p.x - 2.4, p.y + 1.7), 0.11))
            .min(disc(vec2(p.x - 4.4, p.y), 0.11));
        let rim = border(site.inset - 0.42, 0.05);
        let heel = [corner, nails, rim].into_iter().fold(both(-site.inset, behind(p, 6.9, 0.06)), without);
        union(forepart, heel)
    }
    Sole {
        name: "leather_shoe",
        last: Last {
            length: 30.5,
            heel: 3.25,
            waist_out: 2.55,
            waist_inner: 1.65,
            ball_out: 4.9,
            ball_inner: 4.6,
            toe_out: 3.3,
            toe_inner: 3.1,
            tip: -0.5,
        },
        tread,
        stiffness: |_| 0.95,
        worn: 0.6,
        grain: 1.0,
        seed: 11,
    }
}

/// A high heel: the tip of the heel, and a narrow smooth forepart.
pub fn high_heel() -> Sole {
    fn tread(site: &Site) -> f64 {
        let p = site.p;
        let q = vec2(p.x - 0.75, p.y);
        let tip = both(block(q, vec2(0.35, 0.25)) - 0.40, q.x - 0.55);
        let tip = without(tip, border(tip + 0.22, 0.07));
        let forepart = both(0.12 - site.inset, -behind(p, 13.1, 0.16));
        let ribs = both(bars(p.x + 0.05 * p.y * p.y, 0.36, 0.09), both(0.85 - site.inset, (p.x - 17.0).abs() - 1.9));
        union(tip, without(forepart, ribs))
    }
    Sole {
        name: "high_heel",
        last: Last {
            length: 24.0,
            heel: 1.1,
            waist_out: 1.2,
            waist_inner: 0.9,
            ball_out: 3.75,
            ball_inner: 3.7,
            toe_out: 2.15,
            toe_inner: 2.35,
            tip: -0.55,
        },
        tread,
        stiffness: |site| if site.along < 0.1 { 1.5 } else { 1.1 },
        worn: 0.4,
        grain: 0.6,
        seed: 53,
    }
}

/// A driving loafer: round rubber nubs through a smooth leather sole.
pub fn loafer() -> Sole {
    fn tread(site: &Site) -> f64 {
        let p = site.p;
        let nub = disc(p - hexagonal_cell(p, 1.02), 0.33);
        let in_patch = |from: f64, to: f64, inset: f64| both(both(from - p.x, p.x - to), inset - site.inset);
        let forepart = both(nub, in_patch(15.6, 27.9, 0.45));
        let heel = both(nub, in_patch(-0.2, 8.0, 0.4));
        let seam = without(border(site.inset - 0.14, 0.14), bars(p.x + p.y, 0.5, 0.16));
        union(union(forepart, heel), both(seam, 14.0 - p.x))
    }
    Sole {
        name: "loafer",
        last: Last {
            length: 28.8,
            heel: 3.15,
            waist_out: 2.7,
            waist_inner: 1.85,
            ball_out: 4.75,
            ball_inner: 4.55,
            toe_out: 3.55,
            toe_inner: 3.4,
            tip: -0.6,
        },
        tread,
        stiffness: |_| 1.05,
        worn: 0.9,
        grain: 0.2,
        seed: 71,
    }
}

/// A ballerina flat: thin, narrow in the waist, a fine-ribbed tread under ball and heel.
pub fn ballerina() -> Sole {
    fn tread(site: &Site) -> f64 {
        let p = site.p;
        let ribs = bars(p.x + 0.03 * p.y * p.y, 0.42, 0.20);
        let ball = vec2((p.x - 18.2) * 0.8, p.y + 0.1).length() - 2.9;
        let ribbed = both(ball, 0.55 - site.inset);
        let forepart =
            without(both(-site.inset, -behind(p, 13.6, 0.10)), union(border(ribbed, 0.12), both(-ribs, ribbed)));
        let heel = both(-site.inset, behind(p, 5.2, 0.07));
        let heel = without(heel, both(bars(p.y, 0.6, 0.12), both(0.5 - site.inset, behind(p, 4.6, 0.07))));
        union(forepart, heel)
    }
    Sole {
        name: "ballerina",
        last: Last {
            length: 25.5,
            heel: 2.65,
            waist_out: 2.15,
            waist_inner: 1.35,
            ball_out: 4.1,
            ball_inner: 3.9,
            toe_out: 3.2,
            toe_inner: 3.1,
            tip: -0.3,
        },
        tread,
        stiffness: |_| 0.95,
        worn: 0.8,
        grain: 0.5,
        seed: 97,
    }
}
