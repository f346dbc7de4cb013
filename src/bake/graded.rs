use std::path::{Path, PathBuf};

use rayon::prelude::*;

use crate::Error;
use crate::export::{
    self, Atlas, Camera, FloorTextures, OutputFolder, PADDING_PX, PreviewEntry, SDF_FILE, StillEntry, TextureOptions,
    USD_FILE, WallTextures,
};
use crate::files::{LARGEST_IMAGE_BYTES, read_input};
use crate::look::{Background, FloorResolver, Look, LookError, WallResolver, look_files};
use crate::math::Rect;
use crate::progress::{Progress, Stage, Stopwatch};
use crate::show::page::{Page, PageOptions, PageSurface};
use crate::show::scene::{
    self, Mesh, PlainMaterial, Prism, Scene, SceneFile, SceneLamp, SceneOptions, SurfaceImages, WallStrip, write_glb,
    write_sdf, write_usda,
};
use crate::show::still::{FarWalls, STILL_SIZE_PX, Surfaces, WallSurfaces, write_stills};
use crate::show::{self, Ceiling, Crop, Rooms};
use crate::sums::{FloorSums, WallSums};
use crate::walls::{Doorway, Walls};

/// Greatest side of the reduced images in the page and in a model with textures, pixels.
const REDUCED_PX: u32 = 2048;
/// Godot gives a mesh of such a name a static body with its triangles, and takes this off the name.
const GODOT_COLLIDER: &str = "-col";

pub(super) struct Sums {
    pub floor: FloorSums,
    /// `None` for a bake of the floor only.
    pub walls: Option<WallSums>,
}

/// The sums of a walk, with the look and the geometry that turn them into textures.
pub(super) struct Graded<'a> {
    pub sums: &'a Sums,
    pub walls: &'a Walls,
    pub doorways: &'a [Doorway],
    pub ceiling: Ceiling,
    pub look: &'a Look,
    /// Number of people, simulated or recorded.
    pub people: u32,
    /// Number of people whose touches the wall sums hold.
    pub wall_people: u32,
    /// Title of the bake, the name of its plan.
    pub title: String,
    pub seed: u64,
    /// Atlas of the walls; `None` packs a new one.
    pub atlas: Option<Atlas>,
}

pub(super) struct Written {
    pub floor: FloorTextures,
    pub walls: Option<WallTextures>,
    pub pictures: Vec<PreviewEntry>,
    pub stills: Vec<StillEntry>,
}

impl Graded<'_> {
    /// Writes the textures of floor and walls, previews, the model, stills and the page.
    pub fn write(
        &self,
        folder: &OutputFolder,
        options: &TextureOptions,
        crops: &[Crop],
        watch: &Stopwatch,
        progress: &dyn Progress,
    ) -> Result<Written, Error> {
        let options =
            &TextureOptions { reduced_px: self.sums.walls.is_some().then_some(REDUCED_PX), ..options.clone() };
        let floor =
            FloorResolver::new(&self.sums.floor, self.walls, self.look, self.people)?.finely(options.bits == 16);
        let textures = export::floor_textures(folder, self.sums.floor.grid(), &floor, options, progress)?;
        watch.add(Stage::Look, textures.look_busy_s);
        watch.add(Stage::Export, textures.export_busy_s);
        let pictures =
            watch.busy(Stage::Export, || show::write_previews(folder, &textures, &floor, self.walls, crops))?;
        let (walls, stills) = match &self.sums.walls {
            Some(sums) => {
                let (walls, stills) = self.write_walls(sums, (&textures, &floor), folder, options, watch, progress)?;
                (Some(walls), stills)
            }
            None => (None, Vec::new()),
        };
        Ok(Written { floor: textures, walls, pictures, stills })
    }

    fn write_walls(
        &self,
        sums: &WallSums,
        (floor_textures, floor): (&FloorTextures, &FloorResolver<'_>),
        folder: &OutputFolder,
        options: &TextureOptions,
        watch: &Stopwatch,
        progress: &dyn Progress,
    ) -> Result<(WallTextures, Vec<StillEntry>), Error> {
        let wall = WallResolver::new(sums, self.walls, self.look, self.wall_people)?;
        let wall = wall.with_doors(self.walls, self.doorways, self.look);
        let atlas = match &self.atlas {
            Some(atlas) => atlas.clone(),
            None => Atlas::pack(sums.grid(), &self.walls.corners(), options.tile, PADDING_PX)?,
        };
        let textures = export::wall_textures(folder, &atlas, &wall, options, progress)?;
        watch.add(Stage::Look, textures.look_busy_s);
        watch.add(Stage::Export, textures.export_busy_s);
        let model = Model { graded: self, floor: floor_textures, walls: &textures };
        let (rooms, cameras) = watch.busy(Stage::Stills, || {
            let rooms = Rooms::new(self.walls, self.doorways, sums.grid().height_m).under(self.ceiling);
            let rooms = rooms.framed(&self.look.wall).walked(&self.sums.floor);
            let cameras = [rooms.birds_eye(STILL_SIZE_PX), rooms.eye_level(&self.sums.floor)];
            (rooms, cameras)
        });
        let scene = watch.busy(Stage::Scene, || {
            let mut scene = model.scene(sums.grid().height_m);
            let shown = scene.meshes.len();
            if options.ceiling && rooms.grid.roofed {
                scene.meshes.extend(model.ceiling(sums.grid().height_m));
            }
            model.write_scene(&scene, wall.background(), (&rooms, cameras), options, folder)?;
            // The page looks in from above.
            scene.meshes.truncate(shown);
            Ok::<Scene, export::ExportError>(scene)
        })?;
        let clean = [floor.background(), wall.background()];
        let draw = || model.write_stills((floor, &wall), sums, (&rooms, cameras), folder, progress);
        let page = || model.write_page(&scene, clean, (&rooms, cameras), folder);
        let (stills, page) = rayon::join(|| watch.busy(Stage::Stills, draw), || watch.busy(Stage::Page, page));
        let stills = page.and(stills)?;
        Ok((textures, stills))
    }
}

/// Writer of the 3D outputs of a bake: model, stills, page.
struct Model<'a> {
    graded: &'a Graded<'a>,
    floor: &'a FloorTextures,
    walls: &'a WallTextures,
}

impl Model<'_> {
    /// Places of the floor's tiles, metres.
    fn tiles(&self) -> Vec<Rect> {
        self.floor.tiles.iter().map(|tile| Rect { min: tile.min_m, max: tile.max_m }).collect()
    }

    fn scene(&self, wall_height_m: f64) -> Scene {
        let atlas = &self.walls.atlas;
        let strip = |(sheet, strip): (usize, &export::Strip)| WallStrip {
            face: strip.face,
            sheet,
            along_m: [strip.from_m, strip.to_m],
            uv: [(strip.from_m, 0.0), (strip.to_m, 0.0), (strip.from_m, atlas.height_m)]
                .map(|(along_m, height_m)| atlas.uv(sheet, strip, along_m, height_m)),
        };
        let strips: Vec<WallStrip> = atlas.strips().map(strip).collect();
        let options = SceneOptions { wall_height_m, ..SceneOptions::default() };
        scene::build(self.graded.walls, &self.tiles(), &strips, self.graded.doorways, &options)
    }

    fn ceiling(&self, wall_height_m: f64) -> Option<Mesh> {
        let options = SceneOptions { wall_height_m, ..SceneOptions::default() };
        scene::ceiling(self.graded.walls, self.graded.doorways, &options)
    }

    /// The collision shapes of the scene.
    fn hulls(&self, scene: &Scene, rooms: &Rooms) -> Vec<Prism> {
        let options = SceneOptions { wall_height_m: rooms.grid.height_m, ..SceneOptions::default() };
        scene::hulls(self.graded.walls, &self.tiles(), self.graded.doorways, &options, scene)
    }

    /// Writes the scene to the files that are asked for.
    fn write_scene(
        &self,
        scene: &Scene,
        clean: Background,
        (rooms, [above, inside]): (&Rooms, [Camera; 2]),
        options: &TextureOptions,
        folder: &OutputFolder,
    ) -> Result<(), export::ExportError> {
        let [small_floor, small_walls] =
            [&self.floor.reduced, &self.walls.reduced].map(|reduced| if options.embed { &reduced[..] } else { &[] });
        let floor = self.floor.tiles.iter().enumerate().map(|(k, tile)| {
            let name = format!("floor_{}_{}", tile.u, tile.v);
            self.images(name, [&tile.basecolor, &tile.orm, &tile.normal], small_floor.get(k))
        });
        let walls = self.walls.sheets.iter().enumerate().map(|(k, sheet)| {
            let files = [&sheet.basecolor, &sheet.orm, &sheet.normal];
            self.images(format!("walls_{k}"), files, small_walls.get(k))
        });
        let for_unreal = self.floor.target == export::Target::Unreal;
        let hulls = if for_unreal || options.sdf { self.hulls(scene, rooms) } else { Vec::new() };
        let file = SceneFile {
            name: self.graded.title.clone(),
            seed: self.graded.seed,
            floor: floor.collect(),
            walls: walls.collect(),
            clean_wall: PlainMaterial { colour: clean.base_color, roughness: f32::from(clean.orm[1]) / 255.0 },
            hulls: if for_unreal { hulls.iter().filter_map(Prism::mesh).collect() } else { Vec::new() },
            node_suffix: if self.floor.target == export::Target::Godot { GODOT_COLLIDER } else { "" },
            cameras: vec![("birds_eye", above), ("eye_level", inside)],
            picture_px: STILL_SIZE_PX,
            lamps: if options.lamps { SceneLamp::all(rooms) } else { Vec::new() },
            ..SceneFile::default()
        };
        let light_mapped = match options.lightmap {
            0 => None,
            size_px => Some(Scene { meshes: scene.meshes.par_iter().map(|mesh| mesh.light_mapped(size_px)).collect() }),
        };
        folder.write_with("scene.glb", |out| write_glb(out, light_mapped.as_ref().unwrap_or(scene), &file))?;
        if options.usd {
            folder.write_with(USD_FILE, |out| write_usda(out, scene, &file))?;
        }
        if options.sdf { folder.write_with(SDF_FILE, |out| write_sdf(out, scene, &file, &hulls)) } else { Ok(()) }
    }

    fn images<'a>(
        &self,
        name: String,
        [base_color, orm, normal]: [&'a String; 3],
        embedded: Option<&'a export::Reduced>,
    ) -> SurfaceImages<'a> {
        // glTF and USD want green to point up.
        let with_normal = !normal.is_empty() && self.floor.target != export::Target::Unreal;
        let embedded = embedded.map(|reduced| [&reduced.base_color, &reduced.orm]);
        SurfaceImages { name, base_color, orm, normal: with_normal.then_some(normal.as_str()), embedded }
    }

    fn write_stills(
        &self,
        (floor, wall): (&FloorResolver<'_>, &WallResolver<'_>),
        wall_sums: &WallSums,
        (rooms, cameras): (&Rooms, [Camera; 2]),
        folder: &OutputFolder,
        progress: &dyn Progress,
    ) -> Result<Vec<StillEntry>, Error> {
        let Graded { sums, walls, doorways, look, people, wall_people, .. } = *self.graded;
        let look = look.clean();
        let clean = FloorResolver::new(&sums.floor, walls, &look, people)?;
        let clean_wall = WallResolver::new(wall_sums, walls, &look, wall_people)?.with_doors(walls, doorways, &look);
        let floor_texels_per_metre = sums.floor.grid().texels_per_metre;
        let texels_per_metre = wall_sums.grid().texels_per_metre;
        let on_walls = |source, far| Some(WallSurfaces { source, texels_per_metre, far });
        let coats = [
            Surfaces {
                floor,
                floor_texels_per_metre,
                small: Some(&self.floor.birdseye),
                walls: on_walls(wall, FarWalls::Textures(self.walls)),
            },
            Surfaces {
                floor: &clean,
                floor_texels_per_metre,
                small: None,
                walls: on_walls(&clean_wall, FarWalls::Plain),
            },
        ];
        Ok(write_stills(folder, rooms, cameras, coats, progress)?)
    }

    fn write_page(
        &self,
        scene: &Scene,
        [clean_floor, clean_wall]: [Background; 2],
        (rooms, [above, start]): (&Rooms, [Camera; 2]),
        folder: &OutputFolder,
    ) -> Result<(), Error> {
        let look = self.graded.look;
        let page = Page {
            title: &self.graded.title,
            scene,
            walls: self.graded.walls,
            rooms,
            wall_height_m: self.walls.atlas.height_m,
            floor: PageSurface::floor(&self.floor.reduced, look, clean_floor),
            wall: PageSurface::wall(&self.walls.reduced, look, clean_wall),
            start,
            above,
            options: PageOptions::default(),
        };
        Ok(show::page::write_page(folder, &page)?)
    }
}

/// Copies the images of a look to `look/` in the bake, so that it can be resolved anywhere, and returns the look as JSON.
pub(super) fn keep_look(look: &Look, folder: &OutputFolder) -> Result<serde_json::Value, Error> {
    let mut look = look.clone();
    let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    for (number, image) in (1..).zip(look.images().into_iter().flatten()) {
        let kept = format!("look/{number}/{}", name(image));
        for file in look_files(image)? {
            let relative = if image.is_dir() { format!("{kept}/{}", name(&file)) } else { kept.clone() };
            let bytes = read_input(&file, LARGEST_IMAGE_BYTES)
                .map_err(|error| LookError::Image { path: file, message: error.to_string() })?;
            folder.write(&relative, &bytes)?;
        }
        *image = PathBuf::from(kept);
    }
    Ok(look.settings())
}

/// Returns the title of a bake: the file stem of its plan, or of its motion without a plan.
pub(super) fn title(settings: &serde_json::Value) -> String {
    let name = settings["plan"]["image"].as_str().or_else(|| settings["motion"]["file"].as_str()).unwrap_or("plan");
    std::path::Path::new(name).file_stem().unwrap_or_default().to_string_lossy().into_owned()
}
