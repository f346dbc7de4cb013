//! The soles: which parts of each touch the floor.

mod casual;
mod dress;
mod sport;

use trodden::math::Vec2;

use super::Drawing;
use super::foot::{Last, Outline, Site, pressure, print, wear};

/// What is particular about a sole.
struct Sole {
    name: &'static str,
    last: Last,
    /// Signed distance to the parts that touch, negative inside.
    tread: fn(&Site) -> f64,
    /// Factor on the foot's pressure, by place.
    stiffness: fn(&Site) -> f64,
    /// How far its grooves are worn down, 0 to 1.
    worn: f64,
    /// 0 fine rubber, 1 leather.
    grain: f64,
    seed: u64,
}

/// The soles, in the order of `patterns.toml`.
pub fn all() -> Vec<Drawing> {
    let soles = [
        dress::leather_shoe(),
        sport::court_trainer(),
        sport::running_shoe(),
        casual::boot(),
        dress::high_heel(),
        casual::sandal(),
        dress::loafer(),
        sport::canvas_shoe(),
        dress::ballerina(),
        casual::child_shoe(),
    ];
    soles.into_iter().map(Sole::draw).collect()
}

impl Sole {
    fn draw(self) -> Drawing {
        let outline = Outline::new(self.last);
        let frame = outline.frame();
        let coverage = move |p: Vec2| {
            let site = outline.site(p);
            if site.inset < -0.1 {
                return 0.0;
            }
            let worn = self.worn * wear(&site);
            let pressed = pressure(&site) * (self.stiffness)(&site);
            print(&site, (self.tread)(&site), pressed, worn, self.grain, self.seed)
        };
        Drawing { name: self.name, frame, samples: 4, fills: false, coverage: Box::new(coverage) }
    }
}

/// Distance to a curved line across the sole at `x` on the axis, bulging forward (or back, if negative) by
/// `bulge` per squared centimetre; negative behind it.
fn behind(p: Vec2, x: f64, bulge: f64) -> f64 {
    p.x - x + bulge * p.y * p.y
}
