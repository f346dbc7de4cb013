//! Boot, sandal, child's shoe.

use trodden::math::{atan2, sin_cos, vec2};

use super::super::foot::{Last, Site};
use super::super::shape::{bars, block, border, both, disc, hexagonal_cell, star, union, unturned, without};
use super::{Sole, behind};

/// A boot: deep blocks around the edge, crosses down the middle, a separate heel.
pub fn boot() -> Sole {
    fn tread(site: &Site) -> f64 {
        let p = site.p;
        // Blocks stand square to the edge: along the sides they are cut by x, around toe and heel by the angle.
        let (toe, heel) = (24.2, 4.1);
        let quarter = std::f64::consts::FRAC_PI_2;
        let run = if p.x > toe {
            toe + (quarter - atan2(p.y, p.x - toe).abs()) * 4.4
        } else if p.x < heel {
            heel - (quarter - atan2(p.y, heel - p.x).abs()) * 3.7
        } else {
            p.x
        };
        let cuts = bars(run + 0.35, 1.86, 0.50);
        let lug = |depth: f64| without(both(-site.inset, site.inset - depth), cuts);
        let lugs = lug(2.05);
        let crosses = |x: f64| {
            let q = vec2(p.x - x, p.y - 0.1);
            union(block(q, vec2(1.15, 0.46)), block(q, vec2(0.46, 1.40))) - 0.06
        };
        let middle = [17.2, 20.5, 23.8].map(crosses).into_iter().fold(f64::MAX, union);
        let forepart = both(union(lugs, both(middle, 2.4 - site.inset)), -behind(p, 14.4, 0.0));
        let bar = block(vec2(p.x - 4.4, p.y), vec2(1.9, 0.55));
        let heel = both(union(lug(1.75), both(bar, 2.0 - site.inset)), p.x - 8.9);
        let heel = union(heel, both(block(vec2(p.x - 8.45, p.y), vec2(0.45, 9.0)), -site.inset));
        let waist = both((p.x - 11.7).abs() - 1.7, 0.5 - site.inset);
        let ribs = both(bars(p.y, 1.15, 0.42), both(waist, p.y.abs() - 1.9));
        union(union(forepart, heel), ribs)
    }
    Sole {
        name: "boot",
        last: Last {
            length: 31.0,
            heel: 3.95,
            waist_out: 3.35,
            waist_inner: 2.75,
            ball_out: 5.65,
            ball_inner: 5.35,
            toe_out: 4.6,
            toe_inner: 4.3,
            tip: -0.5,
        },
        tread,
        stiffness: |site| if (0.30..0.46).contains(&site.along) { 0.45 } else { 1.1 },
        worn: 0.8,
        grain: 0.3,
        seed: 41,
    }
}

/// A sandal: one flat sole of fine waves with a plain rim.
pub fn sandal() -> Sole {
    fn tread(site: &Site) -> f64 {
        let p = site.p;
        let (s, _) = sin_cos(p.y * 2.3);
        let waves = bars(p.x + 0.22 * s, 0.74, 0.42);
        let rim = both(-site.inset, site.inset - 0.5);
        let panel = block(vec2(p.x - 10.6, p.y - 0.3), vec2(1.2, 1.0)) - 0.35;
        let field = without(both(waves, 0.72 - site.inset), panel - 0.15);
        let inlay = union(without(panel, panel + 0.22), both(bars(p.x - 10.6, 0.62, 0.3), panel + 0.5));
        union(union(rim, field), inlay)
    }
    Sole {
        name: "sandal",
        last: Last {
            length: 28.0,
            heel: 3.45,
            waist_out: 3.5,
            waist_inner: 2.75,
            ball_out: 4.95,
            ball_inner: 4.85,
            toe_out: 4.35,
            toe_inner: 4.35,
            tip: -0.8,
        },
        tread,
        stiffness: |_| 0.95,
        worn: 1.0,
        grain: 0.4,
        seed: 67,
    }
}

/// A child's shoe: short and broad, big discs and stars, waves in the waist.
pub fn child_shoe() -> Sole {
    fn tread(site: &Site) -> f64 {
        let p = site.p;
        let rim = both(-site.inset, site.inset - 0.30);
        let inner = 0.5 - site.inset;
        let cell = hexagonal_cell(p - vec2(0.3, 0.0), 1.55);
        let q = p - vec2(0.3, 0.0) - cell;
        let dots = without(disc(q, 0.6), border(disc(q, 0.3), 0.14));
        let starred = p - vec2(13.2, -0.2);
        let big = star(unturned(starred, 0.3), 1.9);
        let heel_star = star(unturned(p - vec2(3.3, 0.0), 0.3), 1.35);
        let (s, _) = sin_cos(p.y * 1.9);
        let waves = both(bars(p.x + 0.28 * s, 0.95, 0.5), (p.x - 8.1).abs() - 1.6);
        let dots = both(without(without(dots, big - 0.25), heel_star - 0.22), 1.75 - (p.x - 8.1).abs());
        let field = [dots, big, heel_star, waves].into_iter().fold(f64::MAX, union);
        union(rim, both(field, inner))
    }
    Sole {
        name: "child_shoe",
        last: Last {
            length: 19.5,
            heel: 2.65,
            waist_out: 2.75,
            waist_inner: 2.2,
            ball_out: 3.7,
            ball_inner: 3.6,
            toe_out: 3.2,
            toe_inner: 3.15,
            tip: -0.5,
        },
        tread,
        stiffness: |_| 1.0,
        worn: 0.7,
        grain: 0.2,
        seed: 103,
    }
}
