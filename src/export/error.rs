use std::io;
use std::path::{Path, PathBuf};

use crate::files::Unreadable;
use crate::progress::Interrupted;

/// Why the `export` stage failed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The output is a file.
    #[error("the output {} is a file, not a folder", path.display())]
    OutputIsFile {
        /// Path as the user gave it.
        path: PathBuf,
    },
    /// The output has no name, such as `/` or `..`.
    #[error("the output {} cannot be replaced by a new folder", path.display())]
    OutputHasNoName {
        /// Path as the user gave it.
        path: PathBuf,
    },
    /// The output holds files that do not belong to a bake.
    #[error("the output folder {} holds something that is not a bake of trodden ({found})", path.display())]
    NotABake {
        /// Path as the user gave it.
        path: PathBuf,
        /// Name of such a file, or the defect of the manifest.
        found: String,
    },
    /// The output holds an earlier bake.
    #[error("the output folder {} holds an earlier bake", path.display())]
    OutputExists {
        /// Path as the user gave it.
        path: PathBuf,
    },
    /// Another process is writing to the output.
    #[error("another trodden is writing to {} right now", path.display())]
    OutputInUse {
        /// Path as the user gave it.
        path: PathBuf,
    },
    /// A file or folder of the user has the name of the hidden folder beside the output.
    #[error("{} is in the way: trodden needs this name, and it did not make it", path.display())]
    InTheWay {
        /// Path of the hidden folder.
        path: PathBuf,
    },
    /// A file of the user has the name of an output file.
    #[error("{} would be written, but a file of that name is there that no bake has made", path.display())]
    UserFile {
        /// Path of the user's file.
        path: PathBuf,
    },
    /// A path leads out of the output folder.
    #[error(transparent)]
    NotInside(#[from] NotInside),
    /// The output folder cannot be created or replaced.
    #[error("cannot write the output folder {}: {source}", path.display())]
    Folder {
        /// Path as the user gave it.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// A file cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// A file cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// The content of a file is invalid.
    #[error("{}: {problem}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// Its defect.
        problem: String,
    },
    /// The bake has a later format than this version reads.
    #[error("{} has format {found}, this version of trodden reads format {known}", path.display())]
    NewerFormat {
        /// The manifest.
        path: PathBuf,
        /// Format of the manifest.
        found: u32,
        /// Latest format that this version reads.
        known: u32,
    },
    /// Masks of so many bits cannot be written.
    #[error("[texture] bits is {bits}, masks have 8 or 16")]
    Bits {
        /// As the user gave them.
        bits: u32,
    },
    /// The tile size is out of range.
    #[error("the tile size is {tile} px; it has to be {min} to {max} px")]
    TileSize {
        /// Requested tile size, texels.
        tile: u32,
        /// Least tile size, texels.
        min: u32,
        /// Greatest tile size, texels.
        max: u32,
    },
    /// The tile size exceeds the target's largest texture.
    #[error("the tile size is {tile} px; {target} takes textures of at most {max} px")]
    TileTooLargeFor {
        /// Requested tile size, texels.
        tile: u32,
        /// Name of the target.
        target: &'static str,
        /// Largest texture of the target, texels.
        max: u32,
    },
    /// A strip of wall with its padding is taller than a sheet.
    #[error(
        "a wall of {height_m} m at {texels_per_metre} texels per metre needs textures of {needed} px with its padding; \
         they are {sheet} px"
    )]
    WallTooHigh {
        /// Height of the walls, metres.
        height_m: f64,
        /// Texel density of the walls, texels per metre.
        texels_per_metre: f64,
        /// Height of a strip with its padding, texels.
        needed: u32,
        /// Side of the sheets, texels.
        sheet: u32,
    },
    /// The bake is large, or larger than the free disk space.
    #[error("a bake to {} would write {amount}", path.display())]
    TooMuch {
        /// Path of the output as the user gave it.
        path: PathBuf,
        /// What it would write, and what is free on its disk where the system tells, in words.
        amount: String,
    },
    /// Two images to compare have different sizes.
    #[error("{} is {} x {} px, {} is {} x {} px", a.display(), a_size[0], a_size[1], b.display(), b_size[0], b_size[1])]
    SizesDiffer {
        /// First image.
        a: PathBuf,
        /// Its width and height, texels.
        a_size: [u32; 2],
        /// Second image.
        b: PathBuf,
        /// Its width and height, texels.
        b_size: [u32; 2],
    },
    /// Two images to compare have different channels.
    #[error("{} has the channels {a_channels}, {} has {b_channels}", a.display(), b.display())]
    ChannelsDiffer {
        /// First image.
        a: PathBuf,
        /// Its channels.
        a_channels: String,
        /// Second image.
        b: PathBuf,
        /// Its channels.
        b_channels: String,
    },
    /// A part of a bake is none, or does not go with the others.
    #[error("{}: {problem}", path.display())]
    Part {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        problem: String,
        /// What to do about it.
        hint: String,
    },
    /// Days of a bake are in none of its parts.
    #[error("{}: no part has {days}", path.display())]
    PartsMissing {
        /// The folder of the parts.
        path: PathBuf,
        /// The days, and of how many, in words.
        days: String,
    },
    /// One side of a comparison is a bake, the other an image.
    #[error("{} is a folder, {} is a file", folder.display(), file.display())]
    NotAlike {
        /// The folder.
        folder: PathBuf,
        /// The file.
        file: PathBuf,
    },
    /// The user interrupted the run.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
    /// A place to explain lies beyond the plan, or neither on the floor nor near a wall.
    #[error(
        "[{:.2}, {:.2}] {}", place_m[0], place_m[1],
        if *beyond {
            format!("lies beyond the plan; allowed is 0 to {:.2} and 0 to {:.2} m", size_m[0], size_m[1])
        } else {
            "is neither on the floor nor near a wall".to_string()
        }
    )]
    NoSuchPlace {
        /// The place, metres.
        place_m: [f64; 2],
        /// Whether it lies beyond the plan.
        beyond: bool,
        /// Width and height of the plan, metres.
        size_m: [f64; 2],
        /// The nearest place of the floor, metres.
        nearest_m: [f64; 2],
    },
}

impl From<Unreadable> for ExportError {
    fn from(Unreadable { path, source }: Unreadable) -> ExportError {
        ExportError::Read { path, source }
    }
}

impl ExportError {
    /// Suggests a remedy to the user.
    pub fn hint(&self) -> Option<String> {
        match self {
            ExportError::OutputIsFile { .. } | ExportError::OutputHasNoName { .. } => {
                Some("choose another folder with the option `output`".to_string())
            }
            ExportError::NotABake { .. } => Some(
                "choose a new or empty folder with the option `output`; the option `force` replaces bakes only"
                    .to_string(),
            ),
            ExportError::OutputExists { .. } => {
                Some("the option `force` replaces it; the option `output` names another folder".to_string())
            }
            ExportError::OutputInUse { .. } => {
                Some("wait for it, or choose another folder with the option `output`".to_string())
            }
            ExportError::UserFile { .. } => Some("move it away, or choose another folder".to_string()),
            ExportError::InTheWay { path } => Some(format!("move {} away", path.display())),
            ExportError::Folder { source, .. } | ExportError::Write { source, .. } => write_hint(source),
            ExportError::Read { source, .. } if source.kind() == io::ErrorKind::NotFound => {
                Some("a bake is a folder with a manifest.json in it".to_string())
            }
            ExportError::NewerFormat { .. } => Some("bake again, or use the newer version of trodden".to_string()),
            ExportError::Damaged { .. } => Some("bake again, into a new folder".to_string()),
            ExportError::Bits { .. } => Some("8 is enough for most, 16 for masks that are stretched".to_string()),
            ExportError::TileSize { .. } => Some("engines want powers of two, such as 4096 or 8192".to_string()),
            ExportError::TileTooLargeFor { max, .. } => Some(format!("set texture.tile to {max} or less")),
            ExportError::WallTooHigh { needed, .. } => Some(format!(
                "set texture.tile to {} or more, or lower texture.wall_texels_per_metre",
                needed.checked_next_power_of_two().unwrap_or(*needed)
            )),
            ExportError::TooMuch { .. } => Some("lower the texel density of floor and walls".to_string()),
            ExportError::SizesDiffer { .. } | ExportError::ChannelsDiffer { .. } => {
                Some("only bakes of the same plan, texel density and tile size can be compared".to_string())
            }
            ExportError::Part { hint, .. } => Some(hint.clone()),
            ExportError::PartsMissing { .. } => Some("bake these days, and merge again".to_string()),
            ExportError::NoSuchPlace { nearest_m: [x, y], .. } => Some(format!(
                "places are metres from the plan's lower left corner, y upward; the nearest floor is at [{x:.2}, {y:.2}]"
            )),
            ExportError::NotAlike { .. } => Some("compare two bakes or two images".to_string()),
            _ => None,
        }
    }

    pub(super) fn write(path: &Path) -> impl FnOnce(io::Error) -> ExportError + use<'_> {
        move |source| ExportError::Write { path: path.to_path_buf(), source }
    }

    pub(super) fn read(path: &Path) -> impl FnOnce(io::Error) -> ExportError + use<'_> {
        move |source| ExportError::Read { path: path.to_path_buf(), source }
    }

    pub(super) fn damaged(path: &Path, problem: impl std::fmt::Display) -> ExportError {
        ExportError::Damaged { path: path.to_path_buf(), problem: problem.to_string() }
    }
}

/// A path that is no plain name inside a bake.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the path {path:?} does not stay inside the bake: allowed are plain names with / between them")]
pub struct NotInside {
    /// The path.
    pub path: String,
}

fn write_hint(source: &io::Error) -> Option<String> {
    match source.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            Some("the disk is full: make room, or choose another disk with the option `output`".to_string())
        }
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            Some("choose a folder that you may write to with the option `output`".to_string())
        }
        _ => None,
    }
}
