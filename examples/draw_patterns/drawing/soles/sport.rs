//! Trainers.

use trodden::math::{Vec2, vec2};

use super::super::foot::{Last, Site};
use super::super::shape::{bars, border, both, hexagon, hexagonal_cell, segment, union, without, zigzag};
use super::{Sole, behind};

/// A court trainer: herringbone from heel to toe within a rim, a pivot of rings under the ball.
pub fn court_trainer() -> Sole {
    fn tread(site: &Site) -> f64 {
        let p = site.p;
        let wave = p.x + 0.42 * zigzag(p.y, 1.7);
        let herringbone = bars(wave, 0.86, 0.50) * 0.75;
        let rim = both(-site.inset, site.inset - 0.42);
        let field = both(herringbone, 0.62 - site.inset);
        let pivot = vec2(20.6, -1.0);
        let r = p.distance(pivot);
        let rings = both(bars(r, 0.62, 0.40), r - 2.2);
        let field = union(without(field, r - 2.36), both(rings, 0.62 - site.inset));
        // The shank: a smooth plate with one long lozenge cut out of it.
        let plate = both((p.x - 12.0).abs() - 1.75, 0.62 - site.inset);
        let lozenge = (p.x - 12.0).abs() * 0.86 + (p.y - 0.3).abs() * 0.5 - 0.95;
        let field = union(without(field, (p.x - 12.0).abs() - 1.95), without(plate, border(lozenge, 0.22)));
        union(rim, field)
    }
    Sole {
        name: "court_trainer",
        last: Last {
            length: 29.5,
            heel: 3.55,
            waist_out: 3.45,
            waist_inner: 2.6,
            ball_out: 5.2,
            ball_inner: 5.0,
            toe_out: 4.1,
            toe_inner: 3.75,
            tip: -0.9,
        },
        tread,
        stiffness: |_| 1.0,
        worn: 0.9,
        grain: 0.2,
        seed: 23,
    }
}

/// A running shoe: hexagonal studs between flex grooves, a split heel, two struts in place of a full waist.
pub fn running_shoe() -> Sole {
    fn tread(site: &Site) -> f64 {
        let p = site.p;
        let cell = hexagonal_cell(p, 1.34);
        let q = p - cell;
        let stud = without(hexagon(q, 0.54), border(hexagon(q, 0.24), 0.10));
        let studs = both(stud, 0.75 - site.inset);
        // Along the edge: blocks, cut every 1.5 cm.
        let cuts = bars(p.x + 0.35 * p.y.abs(), 1.5, 0.22);
        let edge = without(both(0.0 - site.inset, site.inset - 0.62), cuts);
        let grooves = [17.2, 20.2, 23.2].map(|x| (behind(p, x, 0.07)).abs() - 0.17);
        let split = (p.y - 0.25 + 0.03 * p.x).abs() - 0.28;
        let forepart = both(union(studs, edge), -behind(p, 14.8, 0.05));
        let forepart = grooves.into_iter().fold(forepart, without);
        let heel = without(both(union(studs, edge), behind(p, 9.3, -0.08)), both(split, 1.6 - p.x));
        let strut = |from: Vec2, to: Vec2| both(segment(p, from, to) - 0.5, -site.inset);
        let struts = union(strut(vec2(8.6, 2.2), vec2(15.6, 3.3)), strut(vec2(8.6, -1.9), vec2(15.4, -0.4)));
        let struts = without(struts, bars(p.x - 0.4 * p.y, 0.55, 0.16));
        union(union(forepart, heel), struts)
    }
    Sole {
        name: "running_shoe",
        last: Last {
            length: 29.0,
            heel: 3.6,
            waist_out: 3.4,
            waist_inner: 2.35,
            ball_out: 5.15,
            ball_inner: 4.95,
            toe_out: 3.9,
            toe_inner: 3.6,
            tip: -0.8,
        },
        tread,
        stiffness: |_| 1.0,
        worn: 0.7,
        grain: 0.1,
        seed: 37,
    }
}

/// A canvas shoe: diamonds within a foxing line, a ribbed toe cap, a chequered heel.
pub fn canvas_shoe() -> Sole {
    fn tread(site: &Site) -> f64 {
        let p = site.p;
        let rim = both(-site.inset, site.inset - 0.24);
        let line = border(site.inset - 0.52, 0.14);
        let inner = 0.78 - site.inset;
        let lattice = |pitch: f64, gap: f64| {
            let (a, b) = (p.x * 0.8 + p.y * 0.6, p.x * 0.8 - p.y * 0.6);
            both(-bars(a, pitch, gap), -bars(b, pitch, gap))
        };
        let diamonds = lattice(1.05, 0.26);
        let ribs = bars(p.x + 0.02 * p.y * p.y, 0.55, 0.27);
        let cap = -behind(p, 25.4, 0.05);
        let heel = p.x - 6.6;
        let squares = both(-bars(p.x, 0.66, 0.2), -bars(p.y, 0.66, 0.2));
        let seam = without(without(diamonds, cap - 0.2), heel - 0.2);
        let field = union(union(seam, both(ribs, cap)), both(squares, heel));
        union(union(rim, line), both(field, inner))
    }
    Sole {
        name: "canvas_shoe",
        last: Last {
            length: 28.5,
            heel: 3.25,
            waist_out: 3.05,
            waist_inner: 2.3,
            ball_out: 4.8,
            ball_inner: 4.65,
            toe_out: 4.05,
            toe_inner: 3.9,
            tip: -0.5,
        },
        tread,
        stiffness: |_| 1.0,
        worn: 1.0,
        grain: 0.2,
        seed: 83,
    }
}
