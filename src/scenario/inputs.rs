use std::path::PathBuf;

use super::model::Scenario;
use crate::files::files_in;
use crate::plan;

impl Scenario {
    /// The files that the scenario was read from, and those that a walk or a bake of it reads. No output of the same run
    /// may replace them. Files that do not exist may be among them.
    pub fn input_files(&self) -> Vec<PathBuf> {
        let mut files = self.read_from.clone();
        files.extend(self.image_path().iter().flat_map(|image| plan::files(image)));
        files.extend(self.paint_path());
        files.extend(self.given_recording().map(|(file, _)| file));
        if let Some(formation) = &self.formation {
            let keys = formation.key.iter().filter_map(|key| key.file.as_ref());
            files.extend(keys.chain(&formation.example.file).map(|file| self.folder.join(file)));
        }
        let own = self.routes.routes.iter().filter_map(|route| route.arrivals.as_ref());
        let timetables = own.chain([&self.crowd.arrivals]).filter_map(|timetable| timetable.file.as_ref());
        files.extend(timetables.map(|file| self.folder.join(file)));
        for image in self.look.clone().images().into_iter().flatten() {
            files.extend(if image.is_dir() { files_in(image) } else { vec![image.clone()] });
        }
        let units = self.spots().into_iter().filter_map(|spot| spot.folder);
        files.extend(self.pattern_path().into_iter().chain(units).flat_map(|folder| files_in(&folder)));
        files
    }
}
