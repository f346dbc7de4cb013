//! Every reader of the program, as a function of bytes that a stranger wrote; and small whole inputs of each to begin from.
//!
//! `mutated.rs` damages the inputs a little in every run of the tests; `fuzz/` damages them for hours.

use std::fs;
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};

use image::{DynamicImage, GrayImage, ImageFormat, ImageReader, Luma, Rgba, RgbaImage};
use trodden::Silent;
use trodden::bake::{OutputOptions, bake, bake_part, merge};
use trodden::export::diff::{DiffOptions, diff};
use trodden::export::{Manifest, Report, read_sums, read_wall_sums};
use trodden::features::{Expression, Variables};
use trodden::formation::{FormationRequest, KeyRequest, form};
use trodden::look::Look;
use trodden::motion::Frame;
use trodden::patterns::{Cause, ImportOptions, ImportedPattern, PatternFolder, PhotoScale};
use trodden::plan::{Paint, PlanOptions, read};
use trodden::recordings::{Recording, RecordingOptions};
use trodden::scenario::{Overrides, Scenario};
use trodden::units::UnitLibrary;

use super::building::Building;
use super::write::{self, Walls};

/// A reader of files.
pub struct Reader {
    pub name: &'static str,
    /// Whole inputs.
    pub seeds: fn(&Bench) -> Vec<Vec<u8>>,
    /// Reads bytes, and says whether they could be read. Errors are fine; panics are not.
    pub read: fn(&Bench, &[u8]) -> bool,
}

/// A folder to read in, with a small finished bake and the part of another.
pub struct Bench {
    folder: tempfile::TempDir,
}

/// Larger pictures take their time rightly.
const MOST_PX: u64 = 1 << 16;
/// Frames that are read of a recording: it may last for years.
const MOST_FRAMES: usize = 500;

const SCENARIO: &str = "\
[plan]
image = \"plan.png\"
metres_per_pixel = 0.1

[texture]
floor_texels_per_metre = 8
wall_texels_per_metre = 8
tile = 64

[crowd]
people = 2
days = 2
";

const FULL_SCENARIO: &str = "\
[plan]
image = \"plan.png\"
scale = { from = { px = [12, 40] }, to = { px = [48, 40] }, metres = 3.6 }
crop = [[0.5, 0.5], { px = [70, 5] }]

[crowd]
people = 20
speed = { mean = 1.3, sd = 0.2 }

[[stop]]
name = \"till\"
at = [[2.0, 1.0], [3.0, 1.5]]

[[route]]
from = \"west\"
to = [7.5, 1.5]
share = 0.5

[look.floor]
material = \"vinyl\"

[formation]
duration_s = 4.0
together = [[0, 1]]
key = [{ time_s = 0, shape = \"grid\", columns = 2 }, { time_s = 4, text = \"HI\", wheel_deg = 90 }]
";

impl Bench {
    pub fn new() -> Bench {
        let bench = Bench { folder: tempfile::tempdir().unwrap() };
        bench.write("plan.png", &corridor(ImageFormat::Png));
        bench.write("map.pgm", &corridor(ImageFormat::Pnm));
        bench.write("a.png", &stain());
        let scenario = Scenario::parse(SCENARIO, &bench.path("plan.toml"), &Overrides::default()).unwrap();
        bake(&scenario, &OutputOptions { folder: bench.path("bake"), force: false }, &Silent).unwrap();
        bake_part(&scenario, 1..=1, &bench.path("parts"), false, &Silent).unwrap();
        bake_part(&scenario, 2..=2, &bench.path("parts"), false, &Silent).unwrap();
        bench
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, bytes).unwrap();
        path
    }

    fn plan(&self, name: &str, bytes: &[u8]) -> bool {
        read(&self.write(name, bytes), &PlanOptions::default()).is_ok()
    }

    fn recording(&self, name: &str, bytes: &[u8]) -> bool {
        let Ok(recording) = Recording::open(&self.write(name, bytes), &RecordingOptions::default()) else {
            return false;
        };
        let Ok(mut motion) = recording.motion() else { return false };
        let mut frame = Frame::default();
        for _ in 0..MOST_FRAMES {
            if !matches!(motion.next_frame(&mut frame), Ok(true)) {
                break;
            }
            assert!(
                frame.walkers.iter().all(|walker| walker.position_m.x.is_finite() && walker.position_m.y.is_finite())
            );
        }
        true
    }

    /// Reads the bake with other bytes in one of its files, and puts that back.
    fn of_bake(&self, file: &str, bytes: &[u8], read: impl FnOnce(&Path) -> bool) -> bool {
        let path = self.path("bake").join(file);
        let whole = fs::read(&path).unwrap();
        fs::write(&path, bytes).unwrap();
        let ended = read(&self.path("bake"));
        fs::write(&path, whole).unwrap();
        ended
    }

    fn seed_of_bake(&self, file: &str) -> Vec<Vec<u8>> {
        vec![fs::read(self.path("bake").join(file)).unwrap()]
    }
}

fn encoded(picture: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

/// A corridor of 8 x 3 m at 0.1 m a pixel, with a door between two rooms of it.
fn corridor(format: ImageFormat) -> Vec<u8> {
    let is_floor = |x: u32, y: u32| (5..35).contains(&y) && (x != 40 || (12..24).contains(&y));
    let picture = GrayImage::from_fn(80, 40, |x, y| Luma([if is_floor(x, y) { 255 } else { 0 }]));
    // GIF knows no grey.
    encoded(&DynamicImage::from(picture).to_rgb8().into(), format)
}

/// A dark spot on a light, slightly uneven ground.
fn stain() -> Vec<u8> {
    let value = |x: u32, y: u32| {
        let (dx, dy) = (f64::from(x) - 60.0, f64::from(y) - 24.0);
        let off = dx * dx + 4.0 * dy * dy;
        200 + ((x * 7 + y * 13) % 5) as u8 - if off < 900.0 { 110 } else { 0 }
    };
    encoded(&GrayImage::from_fn(120, 48, |x, y| Luma([value(x, y)])).into(), ImageFormat::Png)
}

fn is_small_picture(bytes: &[u8]) -> bool {
    let reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format().unwrap();
    reader.into_dimensions().is_ok_and(|(width, height)| u64::from(width) * u64::from(height) <= MOST_PX)
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap_or_default()
}

/// Reads everything that `resolve` reads of a bake.
fn read_bake(bake: &Path) -> bool {
    let Ok(manifest) = Manifest::read(bake) else { return false };
    let (look, walls, report) = (manifest.look(bake), manifest.walls(), Report::read(bake));
    let (floor_sums, wall_sums) = (read_sums(bake, &manifest), read_wall_sums(bake, &manifest));
    look.is_ok() && walls.is_ok() && report.is_ok() && floor_sums.is_ok() && wall_sums.is_ok()
}

/// Two people over three moments, in each format of texts.
const RECORDINGS: [&str; 8] = [
    "# framerate: 2.00\n# id frame x/m y/m z/m\n3 10 1 2 1.7\n3 11 1.5 2.25 1.7\n3 12 2 2.5 1.7\n7 11 4 -1 1.7\n7 12 4 -0.5 1.7\n",
    "ID,Frame,x,y,v_x,v_y\n21,1010,0.2,0.5,0.4,0.1\n21,1020,0.365,0.5,0.4,0.1\n21,1030,0.53,0.5,0.4,0.1\n",
    "pedestrianId simTime endTime-PID1 startX-PID1 startY-PID1 endX-PID1 endY-PID1 targetId-PID2\n1 0.0 0.4 0 0 0.5 0 9\n1 0.4 0.8 0.5 0 1 0 9\n2 0.1 0.5 0 0 0 0.4 9\n",
    "time,pedID,posX,posY\n0.00,3,1,2\n0.50,3,1.5,2.25\n0.50,7,4,-1\n1.00,3,2,2.5\n1.00,7,4,-0.5\n",
    "$VISION\n* File: a.inpx\n$PEDESTRIAN:NO;SIMSEC;COORDCENTX;COORDCENTY;SPEED\n3;0,0;1,0;2;1\n3;0,5;1,5;2,25;1\n7;0,5;4;-1;1\n",
    "t,id,name,x,y,z,v\ns,,,m,m,m,m/s\n0,3,\"A, b\",1,2,0,1\n0.5,3,\"A, b\",1.5,2.25,0,1\n0.5,7,c,4,-1,0,1\n1,7,c,4,-0.5,0,1\n",
    "  7.8000000e+02  4.0e+00  4.0e+00  0.0  1.0  1.25  0.0  0.0\n  7.8600000e+02  4.0  4.5  0.0  1.0  1.25  0.0  0.0\n  7.9200000e+02  4.0  5.0  0.0  1.0  1.25  0.0  0.0\n",
    "datetime,id,health,x,y\n2024-05-01T23:59:59.5Z,3,9,1,2\n2024-05-02T00:00:00Z,3,9,1.5,2.25\n2024-05-02T00:00:00Z,7,9,4,-1\n",
];

fn database(_: &Bench) -> Vec<Vec<u8>> {
    let file = tempfile::NamedTempFile::new().unwrap();
    let database = rusqlite::Connection::open(file.path()).unwrap();
    database
        .execute_batch(
            "PRAGMA page_size = 512; VACUUM;
             CREATE TABLE metadata(key TEXT NOT NULL UNIQUE PRIMARY KEY, value TEXT NOT NULL);
             INSERT INTO metadata VALUES ('version', '2'), ('fps', '2');
             CREATE TABLE geometry(hash INTEGER NOT NULL, wkt TEXT NOT NULL);
             CREATE TABLE frame_data(frame INTEGER NOT NULL, geometry_hash INTEGER NOT NULL);
             CREATE TABLE trajectory_data(frame INTEGER NOT NULL, id INTEGER NOT NULL, pos_x REAL NOT NULL,
                 pos_y REAL NOT NULL, ori_x REAL NOT NULL, ori_y REAL NOT NULL);
             INSERT INTO trajectory_data VALUES (0, 3, 1, 2, 1, 0), (1, 3, 1.5, 2.25, 1, 0), (1, 7, 4, -1, 0, 1),
                 (2, 7, 4, -0.5, 0, 1);",
        )
        .unwrap();
    database.close().unwrap();
    vec![fs::read(file.path()).unwrap()]
}

fn packed(_: &Bench) -> Vec<Vec<u8>> {
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    packed.write_all(RECORDINGS[0].as_bytes()).unwrap();
    vec![packed.finish().unwrap()]
}

const PATTERNS: &str =
    "[[pattern]]\nfile = \"a.png\"\ncause = \"heel\"\nlength_cm = 2.6\nshare = 1.0\ndescription = \"x\"\n";
const PATTERN: &[u8] = include_bytes!("../../patterns/heel_dash.png");

pub const READERS: &[Reader] = &[
    Reader {
        name: "plan_image",
        seeds: |_| {
            let formats = [
                ImageFormat::Png,
                ImageFormat::Bmp,
                ImageFormat::Gif,
                ImageFormat::Tiff,
                ImageFormat::Pnm,
                ImageFormat::Jpeg,
            ];
            formats.map(corridor).to_vec()
        },
        read: |bench, bytes| is_small_picture(bytes) && bench.plan("a.image", bytes),
    },
    Reader {
        name: "ros_map",
        seeds: |_| {
            vec![b"image: map.pgm\nresolution: 0.05\norigin: [-1.0, 2.0, 0.1]\nnegate: 0\nmode: trinary\noccupied_thresh: 0.65\nfree_thresh: 0.2\n".to_vec()]
        },
        read: |bench, bytes| bench.plan("map.yaml", bytes),
    },
    Reader {
        name: "rmf",
        seeds: |_| vec![write::rmf(&Building::new(0.1, 0.1)).into_bytes()],
        read: |bench, bytes| bench.plan("a.building.yaml", bytes),
    },
    Reader {
        name: "vtt",
        seeds: |_| vec![write::vtt(&Building::new(0.1, 0.1)).into_bytes()],
        read: |bench, bytes| bench.plan("a.uvtt", bytes),
    },
    Reader {
        name: "svg",
        seeds: |_| {
            let building = Building::new(0.3, 0.12);
            vec![write::svg(&building, 100.0).into_bytes(), write::svg_of_model(&building).into_bytes()]
        },
        read: |bench, bytes| bench.plan("a.svg", bytes),
    },
    Reader {
        name: "pdf",
        seeds: |_| vec![write::pdf(&Building::new(0.3, 0.12), true), write::pdf(&Building::new(0.3, 0.12), false)],
        read: |bench, bytes| bench.plan("a.pdf", bytes),
    },
    Reader {
        name: "dxf",
        seeds: |_| vec![write::dxf(&Building::new(0.3, 0.12), 0.001, 4, Walls::Pieces, [0.0; 2]).into_bytes()],
        read: |bench, bytes| bench.plan("a.dxf", bytes),
    },
    Reader {
        name: "paint",
        seeds: |_| {
            let [r, g, b] = Paint::all().next().unwrap().colour();
            let over = |x, _| if (20..24).contains(&x) { Rgba([r, g, b, 255]) } else { Rgba([0; 4]) };
            vec![encoded(&RgbaImage::from_fn(80, 40, over).into(), ImageFormat::Png)]
        },
        read: |bench, bytes| {
            if !is_small_picture(bytes) {
                return false;
            }
            let paint = Some(bench.write("over.png", bytes));
            let options = PlanOptions { metres_per_pixel: Some(0.1), paint, ..PlanOptions::default() };
            read(&bench.path("plan.png"), &options).is_ok()
        },
    },
    Reader {
        name: "scenario",
        seeds: |_| vec![SCENARIO.into(), FULL_SCENARIO.into(), include_str!("../../docs/scenario.toml").into()],
        read: |bench, bytes| {
            let (path, overrides) = (bench.path("plan.toml"), Overrides::default());
            let Ok(scenario) = Scenario::parse(text(bytes), &path, &overrides) else { return false };
            let again = Scenario::parse(&scenario.to_toml(), &path, &overrides).expect("it reads what it writes");
            assert_eq!(again.settings(), scenario.settings());
            true
        },
    },
    Reader {
        name: "look",
        seeds: |_| {
            let values = "preset = \"wet\"\ntotal_passes = 20000\n[floor]\nmaterial = \"vinyl\"\n";
            vec![values.into(), b"[floor]\nimage = \"a.png\"\nimage_size_m = [1, 0.5]\n".to_vec()]
        },
        read: |bench, bytes| {
            Look::parse(text(bytes), &bench.path("look.toml")).is_ok_and(|look| look.check_images().is_ok())
        },
    },
    Reader {
        name: "look_image",
        seeds: |_| vec![stain()],
        read: |bench, bytes| {
            bench.write("floor.png", bytes);
            let look = Look::parse("[floor]\nimage = \"floor.png\"\n", &bench.path("look.toml")).unwrap();
            if !is_small_picture(bytes) {
                return false;
            }
            look.check_images().is_ok()
        },
    },
    Reader {
        name: "recording",
        seeds: |_| RECORDINGS.map(|text| text.as_bytes().to_vec()).to_vec(),
        read: |bench, bytes| bench.recording("a.txt", bytes),
    },
    Reader { name: "recording_packed", seeds: packed, read: |bench, bytes| bench.recording("a.gz", bytes) },
    Reader { name: "recording_database", seeds: database, read: |bench, bytes| bench.recording("a.sqlite", bytes) },
    Reader {
        name: "patterns",
        seeds: |_| vec![PATTERNS.into()],
        read: |bench, bytes| {
            bench.write("patterns/a.png", PATTERN);
            bench.write("patterns/patterns.toml", bytes);
            PatternFolder::read(&bench.path("patterns")).is_ok()
        },
    },
    Reader {
        name: "pattern_image",
        seeds: |_| vec![PATTERN.to_vec()],
        read: |bench, bytes| {
            if !is_small_picture(bytes) {
                return false;
            }
            bench.write("patterns/a.png", bytes);
            bench.write("patterns/patterns.toml", PATTERNS.as_bytes());
            PatternFolder::read(&bench.path("patterns")).is_ok()
        },
    },
    Reader {
        name: "photograph",
        seeds: |_| vec![stain()],
        read: |_, bytes| {
            let size = PhotoScale::PxPerCm(10.0);
            let options = ImportOptions { cause: Cause::Arm, form: None, size, crop: None, rotate_deg: 5.0 };
            if !is_small_picture(bytes) {
                return false;
            }
            ImportedPattern::from_photo(bytes, &options).is_ok()
        },
    },
    Reader {
        name: "unit",
        seeds: |_| UnitLibrary::built_in_files().iter().take(3).map(|(_, text)| text.as_bytes().to_vec()).collect(),
        read: |bench, bytes| {
            bench.write("units/a.toml", bytes);
            UnitLibrary::load(&bench.path("units")).is_ok()
        },
    },
    Reader {
        name: "formation_picture",
        seeds: |_| vec![stain()],
        read: |bench, bytes| {
            if !is_small_picture(bytes) {
                return false;
            }
            formation(bench, "dots.png", bytes)
        },
    },
    Reader {
        name: "formation_points",
        seeds: |_| vec![b"0 0\n1 0\n0.5 0.9\n".to_vec()],
        read: |bench, bytes| formation(bench, "dots.txt", bytes),
    },
    Reader {
        name: "expression",
        seeds: |_| vec![b"c * (1 + 0.5 * sin(2 * pi * t / duration))".to_vec(), b"min(c, sd) - c^2 * i".to_vec()],
        read: |_, bytes| {
            let variables = Variables { t: 1.0, duration: 9.0, i: 2.0, c: -0.5, sd: 0.3 };
            Expression::parse(text(bytes)).is_ok_and(|expression| !expression.value(&variables).is_infinite())
        },
    },
    Reader {
        name: "manifest",
        seeds: |bench| bench.seed_of_bake("manifest.json"),
        read: |bench, bytes| bench.of_bake("manifest.json", bytes, read_bake),
    },
    Reader {
        name: "report",
        seeds: |bench| bench.seed_of_bake("report.json"),
        read: |bench, bytes| bench.of_bake("report.json", bytes, read_bake),
    },
    Reader {
        name: "sums",
        seeds: |bench| bench.seed_of_bake("sums/floor_presence.exr"),
        read: |bench, bytes| bench.of_bake("sums/floor_presence.exr", bytes, read_bake),
    },
    Reader {
        name: "part",
        seeds: |bench| vec![fs::read(bench.path("parts/days_00001-00001.part")).unwrap()],
        read: |bench, bytes| {
            let parts = [bench.write("a.part", bytes), bench.path("parts/days_00002-00002.part")];
            let output = OutputOptions { folder: bench.path("merged"), force: true };
            merge(&parts, None, &output, false, &Silent).is_ok()
        },
    },
    Reader {
        name: "picture_of_diff",
        seeds: |_| vec![stain()],
        read: |bench, bytes| {
            if !is_small_picture(bytes) {
                return false;
            }
            diff(&bench.write("b.png", bytes), &bench.path("a.png"), &DiffOptions::default()).is_ok()
        },
    },
];

fn formation(bench: &Bench, name: &str, bytes: &[u8]) -> bool {
    bench.write(name, bytes);
    let filled = name.ends_with(".png").then_some(true);
    let key = KeyRequest { file: Some(name.into()), filled, ..KeyRequest::default() };
    let mut request = FormationRequest { key: vec![key], ..FormationRequest::default() };
    request.example.people = Some(3);
    form(&request, &bench.path(""), &Silent).is_ok()
}
