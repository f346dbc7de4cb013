use std::path::Path;

use serde::{Deserialize, Serialize};

use super::ExportError;
use super::bake_path::{BakePath, MANIFEST_NAME};
use super::camera::StillEntry;
use super::layout::{Naming, TileLayout};
use super::options::{SDF_FILE, TextureOptions, USD_FILE};
use super::targets::{TargetEntry, WorldEntry};
use crate::files::read_input;
use crate::look::Look;
use crate::math::Vec2;
use crate::plan::{FloorPlan, Opening, Pose};
use crate::routes::Route;
use crate::walls::{Doorway, Outline, Walls, WallsError};

mod check;
mod one_or_many;
mod walls;

pub use check::{CROP_M, ManifestError};
pub use walls::{SheetEntry, StripEntry, WallsEntry};

/// The floor from above.
const FLOOR_PICTURE: &str = "preview/floor.png";
/// Largest manifest that is read, bytes.
const LARGEST_BYTES: u64 = 512 << 20;
/// Value of `generator` in every manifest of this program, by which a bake is recognised.
pub const GENERATOR: &str = "trodden";
/// Version of the manifest's structure. It grows when an older program cannot read the new structure.
pub const FORMAT: u32 = 1;

/// Description of a bake: its files, and their places in the plan. Stored as `manifest.json`.
///
/// Metres of the plan frame: origin at the plan image's lower-left corner, x right, y up. The same input gives the
/// same bytes: the manifest holds no times, thread counts or absolute paths.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Always `trodden`.
    pub generator: String,
    /// Version of the structure, 1. It grows when an older program cannot read the new structure.
    pub format: u32,
    /// Version of the program.
    pub version: String,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Number of people, simulated or recorded.
    pub people: u32,
    /// Size and pose of the plan.
    pub plan: PlanEntry,
    /// The target program, and the plan's pose in its world.
    #[serde(default)]
    pub target: TargetEntry,
    /// The floor's textures.
    pub floor: FloorEntry,
    /// The walls' textures.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub walls: Option<WallsEntry>,
    /// Overview and crops in `preview/`.
    pub preview: Vec<PreviewEntry>,
    /// The stills in `preview/` and their cameras.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stills: Vec<StillEntry>,
    /// Where the floor meets the plan's sides.
    pub openings: Vec<Opening>,
    /// Doors found in the plan and doors of the scenario. Missing in bakes of earlier versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub doors: Option<Vec<Doorway>>,
    /// The routes of the people.
    pub routes: Vec<Route>,
    /// The look with all its values.
    pub look: serde_json::Value,
    /// The scenario with all its values.
    pub settings: serde_json::Value,
    /// Outlines of the floor, closed loops with the floor on the right. Walls are rebuilt from them.
    pub outlines: Vec<Outline>,
    /// All files of the bake in alphabetical order.
    pub files: Vec<BakePath>,
}

/// Size and pose of the plan image.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PlanEntry {
    /// Width in metres.
    pub width_m: f64,
    /// Height in metres.
    pub height_m: f64,
    /// Side of a pixel in metres.
    pub metres_per_pixel: f64,
    /// Pose of the plan frame in the frame of the ROS map.
    pub map_from_plan: Pose,
}

/// The floor's textures: tiles, channels and sums.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FloorEntry {
    /// Texel density, texels per metre.
    pub texels_per_metre: f64,
    /// Width of the whole floor, texels, without the rest of the last tiles.
    pub width_px: u32,
    /// Height of the whole floor, texels, without the rest of the last tiles.
    pub height_px: u32,
    /// Width and height of each tile's images, texels.
    pub tile_px: [u32; 2],
    /// Naming scheme of the tiles' files.
    pub naming: Naming,
    /// How far colour continues beyond the floor's edge, texels.
    pub padding_px: u32,
    /// Content of each channel of the images.
    pub channels: Vec<ChannelEntry>,
    /// The tiles that hold floor, row by row from the lower left.
    pub tiles: Vec<TileEntry>,
    /// How to read the exact sums.
    pub sums: SumsEntry,
}

/// One channel of the images of a kind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChannelEntry {
    /// Kind of image: `basecolor`, `mask`, `orm`, `mask_map`, `clean`, `dirt`, `layers`, or `layers1` and so on.
    pub image: String,
    /// `R`, `G`, `B`, `A`, or the layer's name.
    pub channel: String,
    /// The property of the surface that it holds.
    pub holds: String,
    /// Encoding of the value, such as `1 - exp(-D)`.
    pub encoding: String,
    /// Bits of a value.
    #[serde(default = "usual_bits")]
    pub bits: u32,
}

/// Bits of a channel in bakes that do not say.
fn usual_bits() -> u32 {
    TextureOptions::default().bits
}

/// One tile: a rectangle of the floor and its images.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TileEntry {
    /// Column u, from the left.
    pub u: u32,
    /// Row v, from below.
    pub v: u32,
    /// UDIM number, if `naming` is `udim`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub udim: Option<u32>,
    /// Lower-left corner in the plan frame, metres.
    pub min_m: Vec2,
    /// Upper-right corner in the plan frame, metres.
    pub max_m: Vec2,
    /// Its rectangle in the target's world.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub world: Option<WorldEntry>,
    /// Path of the base colour, 8 bit sRGB.
    pub basecolor: String,
    /// Path of the packed masks, 8 bit linear: film, prints, edge.
    pub mask: String,
    /// Path of the mask of passes, 8 bit linear grey. Missing in earlier bakes, whose mask has four channels.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub passes: String,
    /// Path of wear, heel marks and height, 8 bit linear. Missing in earlier bakes.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub wear: String,
    /// Path of the floor's normals, 8 bit linear. Missing in earlier bakes.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub normal: String,
    /// Path of occlusion, roughness, metallic, 8 bit linear.
    pub orm: String,
    /// Path of Unity's mask map, for that target: metallic, occlusion, detail, smoothness.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mask_map: Option<String>,
    /// Path of the clean surface's colour, 8 bit sRGB, if it was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub clean: Option<String>,
    /// Path of the dirt on it: colour, 8 bit sRGB, and opacity as alpha.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dirt: Option<String>,
    /// Paths of the layers, half float, linear: one path, or a list. Missing if no layers were written.
    #[serde(default, skip_serializing_if = "Vec::is_empty", with = "one_or_many")]
    pub layers: Vec<String>,
    /// Path of the exact sums.
    pub sums: BakePath,
}

impl TileEntry {
    /// Its images of 8 bits a channel.
    pub(crate) fn images(&self) -> impl Iterator<Item = &String> {
        let images = [&self.basecolor, &self.mask, &self.passes, &self.wear, &self.normal, &self.orm];
        images.into_iter().chain(&self.mask_map).chain(&self.clean).chain(&self.dirt).filter(|file| !file.is_empty())
    }
}

/// Encoding of the exact sums of a floor.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SumsEntry {
    /// Integer that stands for 1, by quantity.
    pub one: std::collections::BTreeMap<String, u32>,
    /// The sum `presence`, one file for the whole floor; `dwell` and `grind` lie in it too if `one` has them.
    pub presence: PresenceEntry,
}

/// The sum `presence`, and those that share its grid.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PresenceEntry {
    /// Path of the sums.
    pub file: BakePath,
    /// Cell density, cells per metre.
    pub texels_per_metre: f64,
    /// Number of columns.
    pub width_px: u32,
    /// Number of rows.
    pub height_px: u32,
}

/// A picture in `preview/` of a rectangle of the floor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PreviewEntry {
    /// Path of the image.
    pub file: String,
    /// Lower-left corner of its rectangle, metres.
    pub min_m: Vec2,
    /// Upper-right corner of its rectangle, metres.
    pub max_m: Vec2,
}

impl Manifest {
    /// Creates a manifest with the entries of plan and program; all other fields are empty.
    pub fn of_plan(plan: &FloorPlan, walls: &Walls, routes: &[Route]) -> Manifest {
        Manifest {
            generator: GENERATOR.to_string(),
            format: FORMAT,
            version: env!("CARGO_PKG_VERSION").to_string(),
            plan: PlanEntry {
                width_m: plan.width_m(),
                height_m: plan.height_m(),
                metres_per_pixel: plan.metres_per_pixel,
                map_from_plan: plan.map_from_plan,
            },
            openings: plan.openings.clone(),
            routes: routes.to_vec(),
            outlines: walls.outlines().to_vec(),
            ..Manifest::default()
        }
    }

    /// Returns the doors of the bake. Earlier versions did not store them; they are found in the walls again.
    pub fn doorways(&self) -> Vec<Doorway> {
        let found = || self.walls().map_or_else(|_| Vec::new(), |walls| walls.doorways());
        self.doors.clone().unwrap_or_else(found)
    }

    /// Returns the number of people whose touches the wall sums hold.
    pub fn wall_people(&self) -> u32 {
        self.walls.as_ref().map_or(self.people, |walls| walls.people)
    }

    /// Rebuilds the walls of the bake from its outlines.
    ///
    /// # Errors
    /// Invalid outlines; [`Manifest::read`] rejects them.
    pub fn walls(&self) -> Result<Walls, WallsError> {
        Walls::from_outlines(self.outlines.clone())
    }

    /// Reads the look of the bake in the folder `bake`.
    ///
    /// The bake holds its images.
    ///
    /// # Errors
    /// The value is not a look, or an image of it lies beyond the bake.
    pub fn look(&self, bake: &Path) -> Result<Look, ExportError> {
        let damaged = |message: String| ExportError::damaged(&bake.join(MANIFEST_NAME), message);
        let mut look = Look::of_settings(&self.look).map_err(damaged)?;
        for image in look.images().into_iter().flatten() {
            let inside = BakePath::new(image.to_string_lossy().into_owned());
            *image = bake.join(inside.map_err(|error| damaged(error.to_string()))?);
        }
        Ok(look)
    }

    /// Returns options that write the same textures. They do not pack sheets: see [`WallsEntry::atlas`].
    pub fn texture_options(&self) -> TextureOptions {
        // For a floor smaller than a tile, the layout finds the same power of two again.
        let [width, height] = self.floor.tile_px;
        let written = self.floor.tiles.iter().any(|tile| !tile.layers.is_empty());
        // The default of the target stays unset, so that another target uses its own.
        let fine = self.floor.channels.iter().any(|channel| channel.image == "mask" && channel.bits == 16);
        let unusual = (written != self.target.name.wants_layers()).then_some(written);
        let lightmap = self.settings["texture"]["lightmap"].as_u64().and_then(|px| u32::try_from(px).ok());
        TextureOptions {
            lightmap: lightmap.unwrap_or(TextureOptions::default().lightmap),
            tile: width.max(height).max(TileLayout::MIN_TILE),
            layers: self.settings["texture"]["layers"].as_bool().or(unusual),
            bits: if fine { 16 } else { usual_bits() },
            dirt: self.floor.tiles.iter().any(|tile| tile.dirt.is_some()),
            small_png: self.settings["texture"]["small_png"].as_bool().unwrap_or_default(),
            target: self.target.name,
            embed: self.settings["texture"]["embed"].as_bool().unwrap_or_default(),
            lamps: self.settings["texture"]["lamps"].as_bool().unwrap_or_default(),
            ceiling: self.settings["texture"]["ceiling"].as_bool().unwrap_or_default(),
            usd: self.files.iter().any(|file| **file == *USD_FILE),
            sdf: self.files.iter().any(|file| **file == *SDF_FILE),
            ..TextureOptions::default()
        }
    }

    /// Serializes the manifest as indented JSON.
    pub fn to_json(&self) -> Vec<u8> {
        let mut json = serde_json::to_vec_pretty(self).expect("all keys are strings and memory does not fail");
        json.push(b'\n');
        json
    }

    /// Reads the manifest of a bake.
    ///
    /// # Errors
    /// A missing manifest, one of another program or a later version, invalid JSON, a value that is out of range or
    /// contradicts another value.
    pub fn read(bake: &Path) -> Result<Manifest, ExportError> {
        let path = bake.join(MANIFEST_NAME);
        let json = read_input(&path, LARGEST_BYTES).map_err(ExportError::read(&path))?;
        let head: Head = serde_json::from_slice(&json).map_err(|e| ExportError::damaged(&path, e))?;
        if head.generator != GENERATOR {
            return Err(ExportError::NotABake { path: bake.to_path_buf(), found: MANIFEST_NAME.to_string() });
        }
        if head.format > FORMAT {
            return Err(ExportError::NewerFormat { path, found: head.format, known: FORMAT });
        }
        let manifest: Manifest = serde_json::from_slice(&json).map_err(|e| ExportError::damaged(&path, e))?;
        manifest.check().map_err(|wrong| ExportError::damaged(&path, wrong))?;
        Ok(manifest)
    }
}

/// The fields that manifests of every version have.
#[derive(Deserialize)]
struct Head {
    generator: String,
    format: u32,
}

/// Lists the files in a folder's manifest, whatever version of this program wrote it.
///
/// # Errors
/// A missing manifest, one of another program, or a path that leads out of the folder.
pub(super) fn listed_files(folder: &Path) -> Result<Vec<BakePath>, ExportError> {
    #[derive(Deserialize)]
    struct List {
        generator: String,
        files: Vec<BakePath>,
    }
    let path = folder.join(MANIFEST_NAME);
    let json = read_input(&path, LARGEST_BYTES).map_err(ExportError::read(&path))?;
    let list: List = serde_json::from_slice(&json).map_err(|e| ExportError::damaged(&path, e))?;
    if list.generator != GENERATOR {
        return Err(ExportError::NotABake { path: folder.to_path_buf(), found: MANIFEST_NAME.to_string() });
    }
    Ok(list.files)
}

/// Reads `generator` of the manifest in a folder.
pub(super) fn generator(folder: &Path) -> Result<String, ExportError> {
    let path = folder.join(MANIFEST_NAME);
    let json = read_input(&path, LARGEST_BYTES).map_err(ExportError::read(&path))?;
    let head: Generator = serde_json::from_slice(&json).map_err(|e| ExportError::damaged(&path, e))?;
    Ok(head.generator)
}

#[derive(Deserialize)]
struct Generator {
    generator: String,
}

#[cfg(test)]
impl Manifest {
    /// Returns the manifest of an empty bake of a plan of this size, at 1 texel per metre.
    pub(in crate::export) fn blank([width_m, height_m]: [f64; 2]) -> Manifest {
        let grid = crate::stamps::TexelGrid::covering(width_m, height_m, 1.0).expect("the plan is small");
        let layout = TileLayout::new(grid, TileLayout::MIN_TILE).expect("the tile size is in range");
        let presence = grid.presence_grid();
        let presence = PresenceEntry {
            texels_per_metre: presence.texels_per_metre,
            width_px: presence.width,
            height_px: presence.height,
            ..PresenceEntry::default()
        };
        Manifest {
            generator: GENERATOR.to_string(),
            format: FORMAT,
            plan: PlanEntry { width_m, height_m, metres_per_pixel: 0.1, ..PlanEntry::default() },
            floor: FloorEntry {
                texels_per_metre: 1.0,
                width_px: grid.width,
                height_px: grid.height,
                tile_px: [layout.width, layout.height],
                naming: layout.naming(),
                sums: SumsEntry { presence, ..SumsEntry::default() },
                ..FloorEntry::default()
            },
            ..Manifest::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::Target;
    use crate::export::targets::Covered;
    use crate::math::vec2;
    use crate::plan::Side;
    use crate::routes::{Gate, Place};
    use crate::walls::WallsOptions;

    fn manifest() -> Manifest {
        let mut floor = vec![1; 40 * 20];
        floor[..40].fill(0);
        let plan = FloorPlan::from_mask(40, 20, 0.1, floor);
        let walls = Walls::trace(&plan, &WallsOptions::default());
        let route = Route {
            name: "west to east".to_string(),
            start: Place::Opening(0),
            via: Vec::new(),
            stops: Vec::new(),
            arrivals: None,
            life: None,
            goal: Place::Area([vec2(3.0, 0.5), vec2(3.5, 1.0)]),
            share: 1.0,
            gates: vec![Gate { left_m: vec2(2.0, 1.9), right_m: vec2(2.0, 0.1) }],
            length_m: 4.0 / 3.0,
        };
        Manifest {
            seed: u64::MAX,
            people: 1000,
            look: serde_json::json!({ "total_passes": 20_000 }),
            floor: FloorEntry {
                texels_per_metre: 100.0,
                width_px: 400,
                height_px: 200,
                tile_px: [512, 256],
                sums: SumsEntry {
                    presence: PresenceEntry {
                        texels_per_metre: 25.0,
                        width_px: 100,
                        height_px: 50,
                        ..PresenceEntry::default()
                    },
                    ..SumsEntry::default()
                },
                channels: Target::Gltf.channels(
                    (Covered::Floor, 8, false),
                    "floor",
                    ["film"; 4],
                    &["passes", "dust"],
                    |_| "optical density D",
                ),
                ..FloorEntry::default()
            },
            ..Manifest::of_plan(&plan, &walls, &[route])
        }
    }

    fn written(text: &[u8]) -> (tempfile::TempDir, Result<Manifest, ExportError>) {
        let dir = tempfile::tempdir().unwrap();
        std::fs::write(dir.path().join(MANIFEST_NAME), text).unwrap();
        let read = Manifest::read(dir.path());
        (dir, read)
    }

    #[test]
    fn a_manifest_comes_back_as_it_was() {
        let manifest = manifest();
        assert!(manifest.openings.iter().any(|opening| opening.side == Side::West));
        assert_eq!(written(&manifest.to_json()).1.unwrap(), manifest);
        assert_eq!(manifest.walls().unwrap().faces, Walls::from_outlines(manifest.outlines.clone()).unwrap().faces);
    }

    #[test]
    fn a_manifest_of_before_there_were_walls_and_targets_still_reads() {
        let mut manifest = manifest();
        let layers = vec!["floor/floor_layers.1001.exr".to_string()];
        let tile = TileEntry { max_m: vec2(5.12, 2.56), layers, ..TileEntry::default() };
        manifest.floor.tiles = vec![tile];
        let mut json: serde_json::Value = serde_json::from_slice(&manifest.to_json()).unwrap();
        assert_eq!(json["floor"]["tiles"][0]["layers"], "floor/floor_layers.1001.exr", "as it was written then");
        json.as_object_mut().unwrap().remove("target").unwrap();
        let read = written(json.to_string().as_bytes()).1.unwrap();
        assert_eq!(read, manifest);
        assert_eq!((read.target.name, read.walls.is_none()), (Target::Gltf, true));
        assert!(read.texture_options().writes_layers());
    }

    #[test]
    fn several_files_of_layers_are_a_list() {
        let layers = vec!["a.exr".to_string(), "b.exr".to_string()];
        let tile = TileEntry { layers: layers.clone(), ..TileEntry::default() };
        let json = serde_json::to_value(&tile).unwrap();
        assert_eq!(json["layers"], serde_json::json!(layers));
        assert_eq!(serde_json::from_value::<TileEntry>(json).unwrap(), tile);
    }

    #[test]
    fn the_look_is_read_back() {
        let look = Look::preset("wet").unwrap();
        let manifest = Manifest { look: look.settings(), ..Manifest::default() };
        assert_eq!(manifest.look(Path::new("out")).unwrap(), look);
        let damaged = Manifest { look: serde_json::json!({ "film": 3 }), ..Manifest::default() };
        assert!(damaged.look(Path::new("out")).unwrap_err().to_string().contains("manifest.json"));
    }

    #[test]
    fn keys_that_a_later_version_adds_do_no_harm() {
        let mut json: serde_json::Value = serde_json::from_slice(&manifest().to_json()).unwrap();
        json["ceiling"] = serde_json::json!({ "texels_per_metre": 200 });
        assert_eq!(written(json.to_string().as_bytes()).1.unwrap(), manifest());
    }

    #[test]
    fn what_cannot_be_used_is_named() {
        let text = |bytes: &[u8]| written(bytes).1.unwrap_err().to_string();
        assert!(text(b"{").contains("line 1"));
        assert!(text(b"").contains("manifest.json"));
        assert!(text(br#"{"generator": "trodden", "format": 2}"#).contains("format 2"));
        assert!(text(br#"{"generator": "trodden", "format": 1}"#).contains("missing field"));
        assert!(matches!(written(br#"{"generator": "x", "format": 1}"#).1, Err(ExportError::NotABake { .. })));
        let nowhere = Manifest::read(Path::new("/nowhere")).unwrap_err();
        assert!(nowhere.hint().is_some_and(|hint| hint.contains("manifest.json")));
    }
}
