//! Checks a manifest: each number, count and length against its range and against the others.
//!
//! A manifest may come from any source. One that passes has sizes that fit in memory, indices within their lists, and
//! points on or near the plan. Texts, the look and the scenario are checked where they are used.

use std::fmt::Display;

use super::{FloorEntry, Manifest, PlanEntry, PreviewEntry, TileEntry, WallsEntry};
use crate::export::layout::{Naming, Tile, TileLayout};
use crate::math::Vec2;
use crate::plan::{LARGEST_M_PER_PX, LARGEST_ORIGIN_M, LARGEST_SIDE_M, SMALLEST_M_PER_PX};
use crate::stamps::TexelGrid;

/// Width and height of a crop, metres.
pub const CROP_M: [f64; 2] = [6.0, 4.0];
/// How far walls, doors and pictures may reach beyond the plan: plan pixels plus metres.
const BEYOND_PX: f64 = 16.0;
const BEYOND_M: f64 = 10.0;
/// Allowed padding, texels.
const PADDING_PX: [f64; 2] = [0.0, 256.0];
/// Allowed texel density, texels per metre.
const DENSITIES: [f64; 2] = [1.0, 1000.0];
/// Allowed height of walls and of door heads, metres.
const HEIGHTS_M: [f64; 2] = [1e-3, 100.0];
/// Largest number in parts that are only copied: gates, cameras, texture coordinates.
const LARGEST_COPIED: f64 = 1e12;
/// Tolerance between a point and the value derived from other fields, metres.
const SAME_M: f64 = 1e-6;

/// A value of a manifest that is out of range or contradicts another value.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("`{field}` is {value}, allowed is {allowed}")]
pub struct ManifestError {
    /// Path of the field, such as `floor.tiles[3].u`.
    pub field: String,
    /// The value.
    pub value: String,
    /// The allowed values.
    pub allowed: String,
}

type Checked = Result<(), ManifestError>;

impl Manifest {
    /// Checks each number, count and length against its range and against the others.
    ///
    /// # Errors
    /// The first value that is out of range or contradicts another value.
    pub fn check(&self) -> Checked {
        let around = Around::of(&self.plan)?;
        let layout = self.floor.check(&self.plan)?;
        for (k, tile) in self.floor.tiles.iter().enumerate() {
            check_tile(tile, &layout, &format!("floor.tiles[{k}]"))?;
            if k > 0 {
                let before = &self.floor.tiles[k - 1];
                let (field, place) = (format!("floor.tiles[{k}]"), format!("column {}, row {}", tile.u, tile.v));
                let ascends = (before.v, before.u) < (tile.v, tile.u);
                ensure(ascends, || (field, place, "a place after that of the tile before it".to_string()))?;
            }
        }
        if let Some(walls) = &self.walls {
            walls.check(&around)?;
        }
        for (k, picture) in self.preview.iter().enumerate() {
            check_picture(picture, &around, &format!("preview[{k}]"))?;
        }
        for (k, still) in self.stills.iter().enumerate() {
            let camera = &still.camera;
            let numbers = camera.position_m.into_iter().chain([camera.heading_deg, camera.pitch_deg, camera.fov_deg]);
            for number in numbers {
                copied(&format!("stills[{k}].camera"), number)?;
            }
        }
        self.check_places(&around)?;
        self.check_outlines(&around)
    }

    fn check_places(&self, around: &Around) -> Checked {
        for (k, opening) in self.openings.iter().enumerate() {
            around.place(|| format!("openings[{k}].from_m"), opening.from_m)?;
            around.place(|| format!("openings[{k}].to_m"), opening.to_m)?;
        }
        for (k, door) in self.doors.iter().flatten().enumerate() {
            for jamb in door.jambs_m {
                around.place(|| format!("doors[{k}].jambs_m"), jamb)?;
            }
            for end in door.leaf_m.into_iter().flatten() {
                around.place(|| format!("doors[{k}].leaf_m"), end)?;
            }
            for (_, along_m) in door.on_faces {
                copied(&format!("doors[{k}].on_faces"), along_m)?;
            }
            within(&format!("doors[{k}].depth_m"), door.depth_m, [0.0, 1e3])?;
            within(&format!("doors[{k}].head_m"), door.head_m, HEIGHTS_M)?;
            for number in <[f64; 2]>::from(door.through) {
                within(&format!("doors[{k}].through"), number, [-1.0 - SAME_M, 1.0 + SAME_M])?;
            }
        }
        for (k, route) in self.routes.iter().enumerate() {
            let gates = route.gates.iter().flat_map(|gate| [gate.left_m, gate.right_m]);
            let numbers = gates.flat_map(<[f64; 2]>::from).chain([route.length_m, route.share]);
            for number in numbers {
                copied(&format!("routes[{k}]"), number)?;
            }
        }
        Ok(())
    }

    fn check_outlines(&self, around: &Around) -> Checked {
        for (k, outline) in self.outlines.iter().enumerate() {
            for (n, &point) in outline.points_m.iter().enumerate() {
                around.place(|| format!("outlines[{k}].points[{n}]"), point)?;
            }
        }
        let field = |outline: Option<usize>| outline.map_or("outlines".to_string(), |k| format!("outlines[{k}]"));
        crate::walls::check_outlines(&self.outlines).map_err(|wrong| ManifestError {
            field: field(wrong.outline()),
            value: wrong.value(),
            allowed: wrong.allowed(),
        })
    }
}

impl FloorEntry {
    /// Checks all but the tiles, and returns the layout of the tiles.
    fn check(&self, plan: &PlanEntry) -> Result<TileLayout, ManifestError> {
        within("floor.texels_per_metre", self.texels_per_metre, DENSITIES)?;
        within("floor.padding_px", f64::from(self.padding_px), PADDING_PX)?;
        let grid = TexelGrid::covering(plan.width_m, plan.height_m, self.texels_per_metre);
        let grid = grid.map_err(|error| ManifestError {
            field: "floor.texels_per_metre".to_string(),
            value: self.texels_per_metre.to_string(),
            allowed: format!("less: {error}"),
        })?;
        same("floor.width_px", self.width_px, grid.width)?;
        same("floor.height_px", self.height_px, grid.height)?;
        let most = f64::from(TileLayout::MAX_TILE);
        for side in self.tile_px {
            within("floor.tile_px", f64::from(side), [1.0, most])?;
        }
        let [width, height] = self.tile_px;
        let tile = width.max(height).max(TileLayout::MIN_TILE);
        let layout = TileLayout::new(grid, tile).map_err(|error| ManifestError {
            field: "floor.tile_px".to_string(),
            value: tile.to_string(),
            allowed: error.to_string(),
        })?;
        same("floor.tile_px[0]", width, layout.width)?;
        same("floor.tile_px[1]", height, layout.height)?;
        let naming = |naming: Naming| format!("{naming:?}").to_lowercase();
        same("floor.naming", naming(self.naming), naming(layout.naming()))?;
        let presence = grid.presence_grid();
        same("floor.sums.presence.width_px", self.sums.presence.width_px, presence.width)?;
        same("floor.sums.presence.height_px", self.sums.presence.height_px, presence.height)?;
        let density = presence.texels_per_metre;
        within(
            "floor.sums.presence.texels_per_metre",
            self.sums.presence.texels_per_metre,
            [density * 0.999, density * 1.001],
        )?;
        Ok(layout)
    }
}

fn check_tile(entry: &TileEntry, layout: &TileLayout, field: &str) -> Checked {
    let below = |count: u32| [0.0, f64::from(count - 1)];
    within(&format!("{field}.u"), f64::from(entry.u), below(layout.columns()))?;
    within(&format!("{field}.v"), f64::from(entry.v), below(layout.rows()))?;
    let (u, v, width, height) = (entry.u, entry.v, layout.width, layout.height);
    let tile = Tile { u, v, i0: u * width, j0: v * height, width, height };
    if let Some(udim) = entry.udim {
        same(&format!("{field}.udim"), udim, tile.udim())?;
    }
    let place = layout.place_m(&tile);
    for (name, found, expected) in [("min_m", entry.min_m, place.min), ("max_m", entry.max_m, place.max)] {
        let near = found.distance(expected) <= SAME_M;
        ensure(near, || (format!("{field}.{name}"), told(found), told(expected)))?;
    }
    Ok(())
}

impl WallsEntry {
    fn check(&self, around: &Around) -> Checked {
        within("walls.texels_per_metre", self.texels_per_metre, DENSITIES)?;
        within("walls.height_m", self.height_m, HEIGHTS_M)?;
        within("walls.padding_px", f64::from(self.padding_px), PADDING_PX)?;
        let most = f64::from(TileLayout::MAX_TILE);
        within("walls.height_px", f64::from(self.height_px), [0.0, most])?;
        for (k, sheet) in self.sheets.iter().enumerate() {
            within(&format!("walls.sheets[{k}].width_px"), f64::from(sheet.width_px), [1.0, most])?;
            within(&format!("walls.sheets[{k}].height_px"), f64::from(sheet.height_px), [1.0, most])?;
            for (n, strip) in sheet.strips.iter().enumerate() {
                let field = format!("walls.sheets[{k}].strips[{n}]");
                // `read_wall_sums` checks the columns against the face, once the walls are known.
                let texel_m = 1.0 / self.texels_per_metre;
                let [_, _, across, up] = strip.rect_px.map(f64::from);
                let from_m = f64::from(strip.first_column) * texel_m;
                let to_m = from_m + if strip.turned { up } else { across } * texel_m;
                within(&format!("{field}.from_m"), strip.from_m, [from_m - texel_m, from_m + texel_m])?;
                within(&format!("{field}.to_m"), strip.to_m, [to_m - 2.0 * texel_m, to_m + texel_m])?;
                strip.points_m.iter().try_for_each(|&p| around.place(|| format!("{field}.points_m"), p))?;
                strip.uv.iter().flatten().try_for_each(|&number| copied(&format!("{field}.uv"), number))?;
            }
        }
        Ok(())
    }
}

/// Checks a picture's rectangle: near the plan, and a crop's no larger than [`CROP_M`].
fn check_picture(picture: &PreviewEntry, around: &Around, field: &str) -> Checked {
    around.place(|| format!("{field}.min_m"), picture.min_m)?;
    around.place(|| format!("{field}.max_m"), picture.max_m)?;
    if picture.file == super::FLOOR_PICTURE {
        return Ok(());
    }
    let most = CROP_M[0].max(CROP_M[1]) + SAME_M;
    let size = picture.max_m - picture.min_m;
    let fits = |side: f64| side > 0.0 && side <= most;
    ensure(fits(size.x) && fits(size.y), || {
        (field.to_string(), format!("{} m large", told(size)), format!("more than 0, up to {most:.1} m a side"))
    })
}

/// The plan's rectangle, enlarged by the allowed margin.
struct Around {
    low_m: f64,
    high_m: Vec2,
}

impl Around {
    fn of(plan: &PlanEntry) -> Result<Around, ManifestError> {
        within("plan.metres_per_pixel", plan.metres_per_pixel, [SMALLEST_M_PER_PX, LARGEST_M_PER_PX])?;
        within("plan.width_m", plan.width_m, [SMALLEST_M_PER_PX, LARGEST_SIDE_M])?;
        within("plan.height_m", plan.height_m, [SMALLEST_M_PER_PX, LARGEST_SIDE_M])?;
        let pose = &plan.map_from_plan;
        for number in [pose.origin_m.x, pose.origin_m.y, pose.yaw_rad] {
            within("plan.map_from_plan", number, [-LARGEST_ORIGIN_M, LARGEST_ORIGIN_M])?;
        }
        let margin_m = BEYOND_M + BEYOND_PX * plan.metres_per_pixel;
        Ok(Around { low_m: -margin_m, high_m: Vec2 { x: plan.width_m + margin_m, y: plan.height_m + margin_m } })
    }

    fn place(&self, field: impl Fn() -> String, place: Vec2) -> Checked {
        for (axis, number, high) in [("x", place.x, self.high_m.x), ("y", place.y, self.high_m.y)] {
            // Written so that NaN is out of range.
            let inside = number >= self.low_m && number <= high;
            let range = || format!("{} to {high}", self.low_m);
            ensure(inside, || (format!("{} ({axis})", field()), number.to_string(), range()))?;
        }
        Ok(())
    }
}

fn within(field: &str, number: f64, [low, high]: [f64; 2]) -> Checked {
    // Written so that NaN is out of range.
    let inside = number >= low && number <= high;
    ensure(inside, || (field.to_string(), number.to_string(), format!("{low} to {high}")))
}

/// Checks a number that is only copied, so that it stays finite.
fn copied(field: &str, number: f64) -> Checked {
    within(field, number, [-LARGEST_COPIED, LARGEST_COPIED])
}

fn same<T: PartialEq + Display>(field: &str, found: T, expected: T) -> Checked {
    ensure(found == expected, || {
        (field.to_string(), found.to_string(), format!("{expected}, which follows from the other values"))
    })
}

fn told(place: Vec2) -> String {
    format!("[{}, {}]", place.x, place.y)
}

fn ensure(fine: bool, wrong: impl FnOnce() -> (String, String, String)) -> Checked {
    if fine {
        return Ok(());
    }
    let (field, value, allowed) = wrong();
    Err(ManifestError { field, value, allowed })
}
