use std::path::Path;

use image::RgbImage;

use crate::Error;
use crate::export::Camera;
use crate::export::{self, Manifest};
use crate::look::{FloorResolver, Look, WallResolver};
use crate::progress::Progress;
use crate::show::Rooms;
use crate::show::still::{FarWalls, Surfaces, WallSurfaces, check_size};

/// How to look at a finished bake.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// Where from; without one, from the height of eyes where there is most to see.
    pub camera: Option<Camera>,
    /// Without a camera: the whole plan from above.
    pub birds_eye: bool,
    /// Horizontal angle of view, degrees; the camera's own if left out.
    pub fov_deg: Option<f64>,
    /// Width and height of the picture, pixels.
    pub size_px: [u32; 2],
    /// Without any dirt.
    pub clean: bool,
    /// The look; that of the bake if left out.
    pub look: Option<Look>,
}

/// Draws what a camera sees of a finished bake; gives the picture and the camera, in the rayon pool that it is called in.
///
/// The bake's exact sums are resolved as finely as the picture shows them; nothing is written.
///
/// # Errors
/// A folder that is not a bake or is damaged; a camera inside a wall or beyond the plan, or a number out of range; a look
/// out of range; [`Error::Interrupted`].
pub fn view(bake: &Path, view: &View, progress: &dyn Progress) -> Result<(RgbImage, Camera), Error> {
    check_size(view.size_px)?;
    let read = || -> Result<_, Error> {
        let manifest = Manifest::read(bake)?;
        let walls = manifest.walls()?;
        let rooms = Rooms::new(&walls, &manifest.doorways(), wall_height_m(&manifest));
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

/// The height that the scenario asked for; earlier bakes may not say it.
fn wall_height_m(manifest: &Manifest) -> f64 {
    let height = manifest.settings["plan"]["wall_height"].as_f64();
    height.filter(|height| (1.0..100.0).contains(height)).unwrap_or(2.6)
}
