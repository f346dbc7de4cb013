use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use trodden::Error;
use trodden::files::files_in;
use trodden::math::{Vec2, sin_cos, vec2};
use trodden::show::{draw_unit, encode_picture};
use trodden::units::{Areas, CutOptions, DiversityReport, SpotFrame, Unit, UnitCut, UnitLibrary, cut};

use super::super::arguments::number_within;
use super::super::print;
use super::super::progress::Watch;
use super::Common;
use super::input::{Alignment, Reading, open, point};

/// Cut crowd units out of a motion: what people do around somebody who stands and looks on; list and draw units
#[derive(Args)]
#[command(after_help = "\
Examples:
  trodden motion units paths.txt --at 14,8.5 --towards 14,15 -o my-units --pictures my-units
  trodden motion units --list                       the units that come with the program
  trodden motion units --list my-units --pictures drawn")]
pub struct Units {
    /// The motion to cut units out of
    #[arg(value_name = "FILE", required_unless_present = "list", conflicts_with = "list")]
    file: Option<PathBuf>,
    #[command(flatten)]
    reading: Reading,
    #[command(flatten)]
    alignment: Alignment,
    /// List the units of a folder instead, or those that come with the program
    #[arg(long, value_name = "FOLDER", num_args = 0..=1)]
    list: Option<Option<PathBuf>>,
    #[command(flatten)]
    spot: SpotArguments,
    /// The folder that the units are written to; it is made. Left out: they are only listed
    #[arg(short, long, value_name = "FOLDER", conflicts_with = "list")]
    output: Option<PathBuf>,
    /// A folder for a picture of each unit (PNG): everybody's way, with a mark at every second
    #[arg(long, value_name = "FOLDER")]
    pictures: Option<PathBuf>,
    /// Replace files that exist
    #[arg(long)]
    force: bool,
    /// Print the list as JSON
    #[arg(long)]
    json: bool,
}

/// Options of the viewer's spot and of cutting.
#[derive(Args)]
#[command(next_help_heading = "Cutting")]
struct SpotArguments {
    /// Where somebody stands and looks on, metres
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    #[arg(required_unless_present = "list")]
    at: Option<[f64; 2]>,
    /// A point that they look at
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    #[arg(required_unless_present_any = ["list", "heading_deg"], conflicts_with = "heading_deg")]
    towards: Option<[f64; 2]>,
    /// Or the direction in which they look, degrees counter-clockwise from +x
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, value_parser = within(-360.0, 360.0))]
    heading_deg: Option<f64>,
    /// What the units are called; their files begin with it [default: the file's name]
    #[arg(long, value_name = "NAME")]
    name: Option<String>,
    /// The most units, those of most interest
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u16).range(1..=1000))]
    most: u16,
    /// Shorter stretches are no units
    #[arg(long, value_name = "S", default_value_t = 3.0, value_parser = within(1.0, 60.0))]
    least_seconds: f64,
    /// Longer ones are cut off
    #[arg(long, value_name = "S", default_value_t = 12.0, value_parser = within(1.0, 120.0))]
    most_seconds: f64,
    /// Whoever else comes nearer than this ends a unit, metres
    #[arg(long, value_name = "M", default_value_t = 0.7, value_parser = within(0.0, 10.0))]
    apart: f64,
    /// Width and depth of the area in front in which people are counted, metres [default: 3,3]
    #[arg(long, value_name = "W,D", value_parser = point)]
    front: Option<[f64; 2]>,
    /// The same behind [default: 3,3]
    #[arg(long, value_name = "W,D", value_parser = point)]
    rear: Option<[f64; 2]>,
    /// Width and depth of the area in front in which units are played, metres [default: 3,7]
    #[arg(long, value_name = "W,D", value_parser = point)]
    area: Option<[f64; 2]>,
}

impl SpotArguments {
    fn areas(&self) -> Areas {
        let usual = Areas::default();
        Areas {
            front_m: self.front.unwrap_or(usual.front_m),
            rear_m: self.rear.unwrap_or(usual.rear_m),
            played_m: self.area.unwrap_or(usual.played_m),
        }
    }

    fn frame(&self) -> Result<SpotFrame, String> {
        let at_m = Vec2::from(self.at.unwrap_or_default());
        let ahead = match (self.towards, self.heading_deg) {
            (Some(point), _) => (Vec2::from(point) - at_m).normalized(),
            (None, degrees) => {
                let (sin, cos) = sin_cos(degrees.unwrap_or_default().to_radians());
                Some(vec2(cos, sin))
            }
        };
        let ahead = ahead.ok_or("--towards is the same point as --at: name another that the viewer looks at")?;
        Ok(SpotFrame { at_m, ahead })
    }

    fn options(&self) -> CutOptions {
        CutOptions {
            areas: self.areas(),
            least_s: self.least_seconds,
            most_s: self.most_seconds,
            apart_m: self.apart,
            most: usize::from(self.most),
            ..CutOptions::default()
        }
    }
}

fn within(low: f64, high: f64) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |text| number_within(text, [low, high])
}

impl Units {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        let areas = self.spot.areas();
        let units = match &self.list {
            Some(folder) => self.listed(folder.as_deref())?,
            None => self.cut(common)?,
        };
        if let Some(folder) = &self.pictures {
            make_folder(folder)?;
            for (file, unit) in &units {
                let picture = encode_picture(&draw_unit(unit, &areas));
                let path = folder.join(file).with_extension("png");
                print::save(&picture, print::plan_file(&path, self.force, &self.inputs())?)?;
            }
        }
        Ok(ExitCode::SUCCESS)
    }

    fn inputs(&self) -> Vec<PathBuf> {
        let listed = self.list.iter().flatten().flat_map(|folder| files_in(folder));
        listed.chain(self.file.clone()).collect()
    }

    /// Reads the units of a folder, or the built-in ones, and lists them.
    fn listed(&self, folder: Option<&Path>) -> anyhow::Result<Vec<(String, Unit)>> {
        let library = UnitLibrary::open(folder).map_err(Error::from)?;
        let rows: Vec<Row> = library.units.iter().map(|unit| Row::of(unit, None)).collect();
        self.tell(&rows, None)?;
        Ok(named(library.units))
    }

    fn cut(&self, common: &Common) -> anyhow::Result<Vec<(String, Unit)>> {
        let Some(file) = &self.file else { return Ok(Vec::new()) };
        let watch = Watch::new(common);
        let frame = self.spot.frame().map_err(anyhow::Error::msg)?;
        let recording = open(file, &self.alignment.over(self.reading.options()), &watch)?;
        let stem = || file.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let name = self.spot.name.clone().or_else(stem).unwrap_or_else(|| "unit".to_string());
        let options = self.spot.options();
        let found = cut(&mut *recording.motion()?, &name, frame, &options, &watch)?;
        drop(watch);
        let rows: Vec<Row> = found.cuts.iter().map(|cut| Row::of(&cut.unit, Some(cut))).collect();
        self.tell(&rows, Some(found.diversity))?;
        let files = named(found.cuts.into_iter().map(|cut| cut.unit).collect());
        if let Some(folder) = &self.output {
            make_folder(folder)?;
            for (file, unit) in &files {
                let text = unit.to_toml();
                let path = folder.join(file).with_extension("toml");
                print::save(text.as_bytes(), print::plan_file(&path, self.force, &self.inputs())?)?;
            }
        }
        Ok(files)
    }

    fn tell(&self, rows: &[Row], measured: Option<DiversityReport>) -> anyhow::Result<()> {
        if self.json {
            let told = serde_json::json!({ "units": rows, "diversity": measured });
            return print::line(serde_json::to_string_pretty(&told)?);
        }
        let width = rows.iter().map(|row| row.name.chars().count()).max().unwrap_or(0).max(4);
        print::line(format!(
            "{:<width$}  {:<16} {:>8} {:>10}  what happens",
            "name", "front | behind", "seconds", "area"
        ))?;
        for row in rows {
            let [w, d] = row.area_m;
            let area = format!("{w} x {d} m");
            let interest = row.interest_bits.map_or(String::new(), |bits| format!("{bits:.2} bits; "));
            let Row { name, groups, duration_s, description, .. } = row;
            print::line(format!("{name:<width$}  {groups:<16} {duration_s:>8.1} {area:>10}  {interest}{description}"))?;
        }
        if let Some(measured) = measured {
            print::line(format!(
                "in the area in front, speeds differ by {:.2} bits and headings by {:.2} bits",
                measured.speed_bits, measured.heading_bits
            ))?;
        }
        Ok(())
    }
}

/// Properties of a unit in the list.
#[derive(serde::Serialize)]
struct Row {
    name: String,
    description: String,
    groups: String,
    duration_s: f64,
    area_m: [f64; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    start_s: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    people: Option<Vec<u32>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    interest_bits: Option<f64>,
}

impl Row {
    fn of(unit: &Unit, cut: Option<&UnitCut>) -> Row {
        Row {
            name: unit.name.clone(),
            description: unit.description.clone(),
            groups: unit.composition_in_words(),
            duration_s: unit.duration_s,
            area_m: unit.area_m,
            start_s: cut.map(|cut| cut.start_s),
            people: cut.map(|cut| cut.ids.clone()),
            interest_bits: cut.map(|cut| cut.interest_bits),
        }
    }
}

/// Gives units unique file names without extension, unique also where case does not count.
fn named(units: Vec<Unit>) -> Vec<(String, Unit)> {
    let mut taken = BTreeSet::new();
    let name = |unit: Unit| {
        let plain = file_name(&unit.name);
        let numbered = (2..).map(|number| format!("{plain}_{number}"));
        let mut names = std::iter::once(plain.clone()).chain(numbered);
        let name = names.find(|name| taken.insert(name.to_lowercase())).unwrap_or(plain);
        (name, unit)
    };
    units.into_iter().map(name).collect()
}

/// Converts a unit's name to a file name without extension.
fn file_name(name: &str) -> String {
    let plain: String = name.chars().map(|c| if c.is_alphanumeric() || "-_".contains(c) { c } else { '_' }).collect();
    let plain = plain.trim_matches('_');
    if plain.is_empty() { "unit".to_string() } else { plain.to_string() }
}

fn make_folder(folder: &Path) -> Result<(), Error> {
    std::fs::create_dir_all(folder)
        .map_err(|source| trodden::files::FileError::Write { path: folder.to_path_buf(), source }.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_unit_gets_a_file_of_its_own() {
        let unit = UnitLibrary::built_in().unwrap().units.remove(0);
        let called = |name: &str| Unit { name: name.to_string(), ..unit.clone() };
        let names: Vec<String> =
            named(["a b", "a_b", "A b", "?!", ""].map(called).to_vec()).into_iter().map(|(file, _)| file).collect();
        assert_eq!(names, ["a_b", "a_b_2", "A_b_3", "unit", "unit_2"]);
    }
}
