//! What is drawn: who does what around the viewer, who stands at the origin and looks along +y.

use super::actor::Scene;

mod behind;
mod groups;
mod several;
mod single;

/// Every scene.
pub fn all() -> Vec<Scene> {
    let mut scenes = single::scenes();
    scenes.extend(groups::scenes());
    scenes.extend(several::scenes());
    scenes.extend(behind::scenes(&scenes));
    scenes
}
