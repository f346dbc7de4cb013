use std::path::Path;

use image::RgbImage;

use crate::Error;
use crate::export::Camera;
use crate::export::{self, Manifest};
use crate::look::{FloorResolver, Look, WallResolver};
use crate::progress::Progress;
use crate::show::still::{FarWalls, Surfaces, WallSurfaces, check_size};
use crate::show::{Ceiling, Rooms};

/// Camera and look of a still of a finished bake.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// Camera; `None` for the best view at eye level, or for the bird's-eye view.
    pub camera: Option<Camera>,
    /// Whether to show the whole plan from above if `camera` is `None`.
    pub birds_eye: bool,
    /// Horizontal angle of view, degrees; `None` for the camera's own.
    pub fov_deg: Option<f64>,
    /// Width and height of the picture, pixels.
    pub size_px: [u32; 2],
    /// Whether to leave out all dirt.
    pub clean: bool,
    /// Look; `None` for the bake's own.
    pub look: Option<Look>,
}

/// Draws a still of a finished bake. Returns the picture and its camera.
///
/// Resolves the bake's exact sums at the resolution of the picture, on the current rayon pool. Writes no files.
///
/// # Errors
/// The folder is not a bake or is damaged; a camera inside a wall, outside the plan or out of range; a look out of
/// range; [`Error::Interrupted`].
pub fn view(bake: &Path, view: &View, progress: &dyn Progress) -> Result<(RgbImage, Camera), Error> {
    check_size(view.size_px)?;
    let read = || -> Result<_, Error> {
        let manifest = Manifest::read(bake)?;
        let walls = manifest.walls()?;
        let rooms = Rooms::new(&walls, &manifest.doorways(), wall_height_m(&manifest)).under(ceiling(&manifest));
        // A camera that cannot be is told of before anything long is done.
        if let Some(camera) = &view.camera {
            rooms.check(&with_fov(*camera, view))?;
        }
        let look = match &view.look {
            Some(look) => look.clone(),
            None => manifest.look(bake)?,
        };
        let (sums, wall_sums) = (export::read_sums(bake, &manifest)?, export::read_wall_sums(bake, &manifest)?);
        Ok((manifest, walls, rooms, look, sums, wall_sums))
    };
    let (manifest, walls, rooms, look, sums, wall_sums) = export::settled(&[bake], read)?;
    let rooms = rooms.framed(&look.wall).walked(&sums);
    let look = if view.clean { look.clean() } else { look };
    let camera = match view.camera {
        Some(camera) => camera,
        None if view.birds_eye => rooms.birds_eye(view.size_px),
        None => rooms.eye_level(&sums),
    };
    let camera = with_fov(camera, view);
    let floor = FloorResolver::new(&sums, &walls, &look, manifest.people)?;
    let wall =
        wall_sums.as_ref().map(|sums| WallResolver::new(sums, &walls, &look, manifest.wall_people())).transpose()?;
    let wall = wall.map(|wall| wall.with_doors(&walls, &manifest.doorways(), &look));
    let on_walls = wall_sums.as_ref().zip(wall.as_ref()).map(|(sums, source)| WallSurfaces {
        source,
        texels_per_metre: sums.grid().texels_per_metre,
        far: FarWalls::Resolved,
    });
    let floor_texels_per_metre = sums.grid().texels_per_metre;
    let coat = Surfaces { floor: &floor, floor_texels_per_metre, small: None, walls: on_walls };
    let pictures = rooms.draw(&camera, view.size_px, &[coat], progress)?;
    let picture = pictures.into_iter().next().expect("there is one picture for each coat");
    Ok((picture, camera))
}

fn with_fov(camera: Camera, view: &View) -> Camera {
    Camera { fov_deg: view.fov_deg.unwrap_or(camera.fov_deg), ..camera }
}

/// Returns what the scenario has over the rooms. Earlier bakes may lack it.
pub(super) fn ceiling(manifest: &Manifest) -> Ceiling {
    serde_json::from_value(manifest.settings["plan"]["ceiling"].clone()).unwrap_or_default()
}

/// Returns the scenario's wall height, metres. Earlier bakes may lack it.
fn wall_height_m(manifest: &Manifest) -> f64 {
    let height = manifest.settings["plan"]["wall_height"].as_f64();
    height.filter(|height| (1.0..100.0).contains(height)).unwrap_or(2.6)
}
