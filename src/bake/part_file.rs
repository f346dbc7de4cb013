//! The file of a part: a line of JSON that says whose days it holds, then counts and blocks of sums, packed, then a checksum.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use flate2::{Compression, CrcReader, CrcWriter, read::ZlibDecoder, write::ZlibEncoder};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::site::Trodden;
use super::tread::Walked;
use crate::Error;
use crate::export::ExportError;
use crate::files::{LARGEST_IMAGE_BYTES, WholeFile, open_input};
use crate::patterns::Cause;
use crate::progress::Progress;
use crate::scenario::{Overrides, Scenario, ScenarioError};
use crate::sums::{BLOCK, Quantity};

const GENERATOR: &str = "trodden part";
/// Version of the file's structure.
const FORMAT: u32 = 1;
/// Longest first line, bytes.
const LONGEST_HEAD: u64 = 64 << 20;
/// Longest record: a block packs smaller, counts grow with people who got stuck.
const LONGEST_RECORD: u32 = 1 << 30;
/// Number of blocks that are packed or unpacked in parallel.
const BATCH: usize = 256;
/// Kinds of records beside those of [`Quantity::ALL`]; the causes of [`Cause::WALL`] follow `WALLS`.
const WALLS: u32 = 100;
const COUNTS: u32 = 200;
const END: u32 = u32::MAX;

/// What a part is of: its days, and everything that decides what they leave.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Head {
    generator: String,
    format: u32,
    version: String,
    /// First and last day, counted from 1.
    pub days: [u32; 2],
    /// Number of days of the whole bake.
    pub of: u32,
    /// The scenario with all its values.
    pub settings: Value,
    /// The files that it reads, plan, patterns, images, and a number that tells their content.
    pub inputs: Vec<(String, String)>,
    /// The scenario as a file, and the folder that its paths start from.
    scenario: String,
    folder: PathBuf,
}

impl Head {
    /// # Errors
    /// An input cannot be read.
    pub fn of(scenario: &Scenario, days: RangeInclusive<u32>) -> Result<Head, ExportError> {
        let folder = std::path::absolute(Path::new(".").join(&scenario.folder)).map_err(read(&scenario.folder))?;
        let mut relative = scenario.clone();
        relative.read_from.clear();
        let mut inputs = Vec::new();
        for path in relative.input_files().into_iter().filter(|path| path.is_file()) {
            let name = path.strip_prefix(&scenario.folder).unwrap_or(Path::new(path.file_name().unwrap_or_default()));
            inputs.push((name.to_string_lossy().replace('\\', "/"), fingerprint(&path).map_err(read(&path))?));
        }
        inputs.sort();
        for image in relative.look.images().into_iter().flatten() {
            // The folder comes before them again when the scenario is read.
            *image = image.strip_prefix(&scenario.folder).map_or_else(|_| image.clone(), Path::to_path_buf);
        }
        Ok(Head {
            generator: GENERATOR.into(),
            format: FORMAT,
            version: env!("CARGO_PKG_VERSION").into(),
            days: [*days.start(), *days.end()],
            of: scenario.days,
            settings: scenario.settings(),
            inputs,
            scenario: relative.to_toml(),
            folder,
        })
    }

    /// The scenario, whose paths start from `folder` if that is given.
    pub fn scenario(&self, folder: Option<&Path>) -> Result<Scenario, ScenarioError> {
        let place = folder.unwrap_or(&self.folder).join("scenario.toml");
        Scenario::parse(&self.scenario, &place, &Overrides::default())
    }

    /// How this differs from a part of the same bake, in words.
    pub fn difference(&self, other: &Head) -> Option<String> {
        if self.version != other.version {
            return Some(format!("it is of trodden {}, not {}", self.version, other.version));
        }
        if let Some(difference) = difference(&self.settings, &other.settings, "") {
            return Some(format!("it is of another scenario: {difference}"));
        }
        let theirs = |input: &&(String, String)| !other.inputs.contains(input);
        let differing =
            self.inputs.iter().find(theirs).or_else(|| other.inputs.iter().find(|i| !self.inputs.contains(i)));
        differing.map(|(name, _)| format!("it is of another {name}: the file has changed"))
    }
}

fn read(path: &Path) -> impl Fn(io::Error) -> ExportError {
    move |source| ExportError::Read { path: path.to_path_buf(), source }
}

/// FNV-1a of a file, 128 bits.
fn fingerprint(path: &Path) -> io::Result<String> {
    let mut file = open_input(path)?.take(LARGEST_IMAGE_BYTES);
    let (mut hash, mut bytes) = (0x6c62_272e_07bb_0142_62b8_2175_6295_c58d_u128, vec![0; 1 << 16]);
    loop {
        let count = file.read(&mut bytes)?;
        if count == 0 {
            return Ok(format!("{hash:032x}"));
        }
        for &byte in &bytes[..count] {
            hash = (hash ^ u128::from(byte)).wrapping_mul(0x0100_0000_0000_0000_0000_013b);
        }
    }
}

/// The first value that two settings do not share.
pub(super) fn difference(ours: &Value, theirs: &Value, key: &str) -> Option<String> {
    if let (Value::Object(a), Value::Object(b)) = (ours, theirs) {
        let keys = a.keys().chain(b.keys().filter(|key| !a.contains_key(*key)));
        let within = |name: &String| {
            let key = if key.is_empty() { name.clone() } else { format!("{key}.{name}") };
            difference(a.get(name).unwrap_or(&Value::Null), b.get(name).unwrap_or(&Value::Null), &key)
        };
        return keys.filter_map(within).next();
    }
    if let (Value::Array(a), Value::Array(b)) = (ours, theirs) {
        let within = |(number, (a, b)): (usize, (&Value, &Value))| difference(a, b, &format!("{key}[{number}]"));
        let longer = || (a.len() != b.len()).then(|| format!("`{key}` has {} entries, not {}", a.len(), b.len()));
        return a.iter().zip(b).enumerate().filter_map(within).next().or_else(longer);
    }
    let shown = |value: &Value| if value.is_null() { "left out".to_string() } else { value.to_string() };
    (ours != theirs).then(|| format!("`{key}` is {}, not {}", shown(ours), shown(theirs)))
}

/// A record: its kind, a wall's face or 0, its lower-left cell, its bytes.
type Record = ([u32; 4], Vec<u8>);

fn packed(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut packer = ZlibEncoder::new(Vec::new(), Compression::fast());
    packer.write_all(bytes)?;
    packer.finish()
}

fn unpacked(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut out = Vec::new();
    ZlibDecoder::new(bytes).take(LONGEST_RECORD.into()).read_to_end(&mut out)?;
    Ok(out)
}

/// Writes a part.
///
/// # Errors
/// An error of the system; an interruption.
pub(super) fn write(file: &WholeFile, head: &Head, trodden: &Trodden, progress: &dyn Progress) -> Result<(), Error> {
    let mut out = CrcWriter::new(file.create()?);
    write_to(&mut out, head, trodden, progress).map_err(|error| file.failed(error))?;
    let sum = out.crc().sum();
    let mut out = out.into_inner();
    out.write_all(&sum.to_le_bytes()).and_then(|()| out.flush()).map_err(|error| file.failed(error))?;
    progress.keep_on()?;
    Ok(())
}

fn write_to(out: &mut impl Write, head: &Head, trodden: &Trodden, progress: &dyn Progress) -> io::Result<()> {
    serde_json::to_writer(&mut *out, head)?;
    out.write_all(b"\n")?;
    let mut push = |place: [u32; 4], bytes: &[u8]| {
        place.into_iter().chain([bytes.len() as u32]).try_for_each(|number| out.write_all(&number.to_le_bytes()))?;
        out.write_all(bytes)
    };
    let rooms: Vec<u64> = trodden.life.iter().flat_map(|life| &life.rooms).map(|room| room.footfalls).collect();
    push([COUNTS, 0, 0, 0], &packed(&serde_json::to_vec(&(&trodden.walked, rooms))?)?)?;
    let sums = &trodden.sums;
    let of_floor =
        |quantity: Quantity| sums.floor.blocks(quantity).into_iter().map(move |[i0, j0]| [quantity as u32, 0, i0, j0]);
    let mut places: Vec<[u32; 4]> = Quantity::ALL.into_iter().flat_map(of_floor).collect();
    for (walls, cause) in sums.walls.iter().flat_map(|walls| Cause::WALL.map(|cause| (walls, cause))) {
        let kind = WALLS + cause.on_wall().unwrap_or_default() as u32;
        places.extend(walls.blocks(cause).into_iter().map(|(face, [i0, j0])| [kind, face as u32, i0, j0]));
    }
    for places in places.chunks(BATCH) {
        if progress.interrupted() {
            break;
        }
        let pack = |&[kind, face, i0, j0]: &[u32; 4]| {
            let mut values = vec![0; BLOCK * BLOCK];
            match (Quantity::ALL.get(kind as usize), &sums.walls) {
                (Some(&quantity), _) => sums.floor.read(quantity, i0, j0, BLOCK, BLOCK, &mut values),
                (None, Some(walls)) => {
                    let cause = Cause::WALL[(kind - WALLS) as usize];
                    walls.read(cause, face as usize, i0, j0, BLOCK, BLOCK, &mut values);
                }
                (None, None) => {}
            }
            packed(&values.iter().flat_map(|value| value.to_le_bytes()).collect::<Vec<u8>>())
        };
        let blocks: Vec<Vec<u8>> = places.par_iter().map(pack).collect::<io::Result<_>>()?;
        places.iter().zip(&blocks).try_for_each(|(&place, block)| push(place, block))?;
    }
    push([END, 0, 0, 0], &[])
}

/// A part whose head has been read.
#[derive(Debug)]
pub(super) struct PartFile {
    pub path: PathBuf,
    pub head: Head,
    content: CrcReader<BufReader<File>>,
}

impl PartFile {
    /// Opens a part and reads its head.
    ///
    /// # Errors
    /// The file cannot be read; it is no part, or one of a later format.
    pub fn open(path: &Path) -> Result<PartFile, ExportError> {
        let file = open_input(path).map_err(read(path))?;
        let mut content = CrcReader::new(BufReader::with_capacity(1 << 20, file));
        let mut line = Vec::new();
        content.by_ref().take(LONGEST_HEAD).read_until(b'\n', &mut line).map_err(read(path))?;
        let value: Value = serde_json::from_slice(&line).unwrap_or_default();
        let no_part = |problem: String| ExportError::Part {
            path: path.to_path_buf(),
            problem,
            hint: "remove it, or name the parts one by one".into(),
        };
        if value["generator"] != GENERATOR {
            return Err(no_part("it is not a part of a bake".into()));
        }
        if value["format"] != FORMAT {
            return Err(no_part(format!("its format is {}, this version of trodden reads {FORMAT}", value["format"])));
        }
        let head: Head = serde_json::from_value(value).map_err(|error| no_part(error.to_string()))?;
        let [from, to] = head.days;
        if from == 0 || from > to || to > head.of {
            return Err(no_part(format!("it has the days {from} to {to} of {}", head.of)));
        }
        Ok(PartFile { path: path.to_path_buf(), head, content })
    }

    /// Checks that all of the file is there, as it was written.
    ///
    /// # Errors
    /// A file that is cut short or damaged.
    pub fn check(mut self) -> Result<(), ExportError> {
        let path = self.path.clone();
        self.each_batch(|_| Ok(())).map_err(read(&path))
    }

    /// Adds sums and counts.
    ///
    /// # Errors
    /// A file that is cut short, damaged, or of another floor.
    pub fn add_to(mut self, trodden: &mut Trodden) -> Result<(), ExportError> {
        let path = self.path.clone();
        self.each_batch(|records| add(records, trodden)).map_err(read(&path))
    }

    /// Passes on all records in batches, and compares the checksum.
    fn each_batch(&mut self, mut take: impl FnMut(Vec<Record>) -> io::Result<()>) -> io::Result<()> {
        loop {
            let (mut batch, mut is_over) = (Vec::new(), false);
            while batch.len() < BATCH && !is_over {
                let mut numbers = [0; 5];
                for number in &mut numbers {
                    *number = u32_of(&mut self.content)?;
                }
                let [kind, face, i0, j0, length] = numbers;
                is_over = kind == END;
                if length > LONGEST_RECORD {
                    return Err(damaged());
                }
                let mut bytes = Vec::new();
                self.content.by_ref().take(length.into()).read_to_end(&mut bytes)?;
                if bytes.len() != length as usize {
                    return Err(io::ErrorKind::UnexpectedEof.into());
                }
                if !is_over {
                    batch.push(([kind, face, i0, j0], bytes));
                }
            }
            take(batch)?;
            if is_over {
                let sum = self.content.crc().sum();
                return if u32_of(&mut self.content)? == sum { Ok(()) } else { Err(damaged()) };
            }
        }
    }
}

fn damaged() -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, "its bytes are not those that were written")
}

fn u32_of(content: &mut impl Read) -> io::Result<u32> {
    let mut bytes = [0; 4];
    content.read_exact(&mut bytes)?;
    Ok(u32::from_le_bytes(bytes))
}

fn add(records: Vec<Record>, trodden: &mut Trodden) -> io::Result<()> {
    let unpack = |(place, bytes): Record| Ok((place, unpacked(&bytes)?));
    for ([kind, face, i0, j0], bytes) in records.into_par_iter().map(unpack).collect::<io::Result<Vec<Record>>>()? {
        if kind == COUNTS {
            let (walked, rooms): (Walked, Vec<u64>) = serde_json::from_slice(&bytes)?;
            trodden.walked.add(walked);
            let counts = trodden.life.iter_mut().flat_map(|life| &mut life.rooms).zip(rooms);
            counts.for_each(|(room, footfalls)| room.footfalls += footfalls);
            continue;
        }
        let values: Vec<u32> = bytes.as_chunks().0.iter().map(|bytes| u32::from_le_bytes(*bytes)).collect();
        let cause = kind.checked_sub(WALLS).and_then(|kind| Cause::WALL.get(kind as usize));
        match (Quantity::ALL.get(kind as usize), cause, &mut trodden.sums.walls) {
            (Some(&quantity), _, _) => trodden.sums.floor.add_block(quantity, i0, j0, BLOCK, BLOCK, &values),
            (None, Some(&cause), Some(walls)) => {
                walls.add_block(cause, face as usize, i0, j0, [BLOCK, BLOCK], &values);
            }
            _ => return Err(damaged()),
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_comes_back(scenario: &Scenario) {
        let head = Head::of(scenario, 1..=1).unwrap();
        let back = head.scenario(None).unwrap_or_else(|error| panic!("{error}\n{}", head.scenario));
        assert_eq!(head.difference(&Head::of(&back, 1..=1).unwrap()), None, "{}", head.scenario);
    }

    #[test]
    fn a_head_gives_the_scenario_back() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let samples = std::fs::read_dir(root.join("floorplans")).unwrap().map(|entry| entry.unwrap().path());
        let samples: Vec<PathBuf> = samples.filter(|path| path.extension().is_some_and(|it| it == "toml")).collect();
        assert!(samples.len() >= 5);
        for path in samples {
            for overrides in [Overrides::default(), Overrides { quick: true, seed: Some(9), ..Overrides::default() }] {
                assert_comes_back(&Scenario::read(&path, &overrides).unwrap());
            }
        }
    }

    #[test]
    fn files_beside_a_scenario_are_part_of_it() {
        let dir = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| std::fs::write(dir.path().join(name), text).unwrap();
        write("plan.png", "not looked at");
        write("tile.png", "nor this");
        write("look.toml", "total_passes = 777\n[floor]\nmaterial = \"wood\"\n");
        write("times.csv", "0, 4\n60, 20\n");
        let text = "[plan]\nimage = \"plan.png\"\n[crowd]\narrivals = { kind = \"list\", file = \"times.csv\" }\n[look]\nfile = \"look.toml\"\n\
                    [[look.area]]\noutline = [[1, 1], [2, 2]]\nfloor = { image = \"tile.png\" }\n";
        write("scenario.toml", text);
        let read = || Scenario::read(&dir.path().join("scenario.toml"), &Overrides::default()).unwrap();
        let scenario = read();
        assert_comes_back(&scenario);
        let before = Head::of(&scenario, 1..=1).unwrap();
        let names: Vec<&str> = before.inputs.iter().map(|(name, _)| &**name).collect();
        assert_eq!(names, ["plan.png", "tile.png", "times.csv"]);
        write("tile.png", "another");
        let difference = Head::of(&scenario, 1..=1).unwrap().difference(&before).unwrap();
        assert_eq!(difference, "it is of another tile.png: the file has changed");
        write("look.toml", "total_passes = 778\n");
        let difference = Head::of(&read(), 1..=1).unwrap().difference(&before).unwrap();
        assert!(difference.starts_with("it is of another scenario: `look."), "{difference}");
    }
}
