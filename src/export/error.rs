use std::io;
use std::path::{Path, PathBuf};

use crate::files::Unreadable;
use crate::progress::Interrupted;

/// Why the `export` stage cannot go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The output is a file.
    #[error("the output {} is a file, not a folder", path.display())]
    OutputIsFile {
        /// The output as the user gave it.
        path: PathBuf,
    },
    /// The output has no name of its own, as `/` or `..`.
    #[error("the output {} cannot be replaced by a new folder", path.display())]
    OutputHasNoName {
        /// The output as the user gave it.
        path: PathBuf,
    },
    /// The output holds something else.
    #[error("the output folder {} holds something that is not a bake of trodden ({found})", path.display())]
    NotABake {
        /// The output as the user gave it.
        path: PathBuf,
        /// The name of something in it, or what is wrong with its manifest.
        found: String,
    },
    /// The output holds an earlier bake.
    #[error("the output folder {} holds an earlier bake", path.display())]
    OutputExists {
        /// The output as the user gave it.
        path: PathBuf,
    },
    /// Somebody else writes to the output right now.
    #[error("another trodden is writing to {} right now", path.display())]
    OutputInUse {
        /// The output as the user gave it.
        path: PathBuf,
    },
    /// The folder beside the output, in which results are collected, is taken by something else.
    #[error("{} is in the way: trodden needs this name, and it did not make it", path.display())]
    InTheWay {
        /// The folder.
        path: PathBuf,
    },
    /// A file that no bake made has the name of one that the bake makes.
    #[error("{} would be written, but a file of that name is there that no bake has made", path.display())]
    UserFile {
        /// The file that is there.
        path: PathBuf,
    },
    /// A path leads out of the output folder.
    #[error(transparent)]
    NotInside(#[from] NotInside),
    /// The output folder cannot be made or replaced.
    #[error("cannot write the output folder {}: {source}", path.display())]
    Folder {
        /// The output as the user gave it.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A file cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A file cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A file was read, but what it holds cannot be used.
    #[error("{}: {problem}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        problem: String,
    },
    /// A bake of a later version.
    #[error("{} has format {found}, this version of trodden reads format {known}", path.display())]
    NewerFormat {
        /// The manifest.
        path: PathBuf,
        /// Its format.
        found: u32,
        /// The format that this version writes.
        known: u32,
    },
    /// A tile size out of range.
    #[error("the tile size is {tile} px; it has to be {min} to {max} px")]
    TileSize {
        /// What was asked for.
        tile: u32,
        /// The least size.
        min: u32,
        /// The greatest size.
        max: u32,
    },
    /// A tile size beyond what the target takes.
    #[error("the tile size is {tile} px; {target} takes textures of at most {max} px")]
    TileTooLargeFor {
        /// What was asked for.
        tile: u32,
        /// The target.
        target: &'static str,
        /// The greatest size that it takes.
        max: u32,
    },
    /// A sheet in which not even one strip of wall fits.
    #[error(
        "a wall of {height_m} m at {texels_per_metre} texels per metre needs textures of {needed} px with its padding; \
         they are {sheet} px"
    )]
    WallTooHigh {
        /// Height of the walls, metres.
        height_m: f64,
        /// Their texel density.
        texels_per_metre: f64,
        /// Height of a strip with its padding, texels.
        needed: u32,
        /// Side of the sheets, texels.
        sheet: u32,
    },
    /// A bake that is large, or larger than the disk has room for.
    #[error("a bake to {} would write {amount}", path.display())]
    TooMuch {
        /// The output as the user gave it.
        path: PathBuf,
        /// What it would write, and what is free on its disk where the system tells, in words.
        amount: String,
    },
    /// Two images of different size were to be compared.
    #[error("{} is {} x {} px, {} is {} x {} px", a.display(), a_size[0], a_size[1], b.display(), b_size[0], b_size[1])]
    SizesDiffer {
        /// One image.
        a: PathBuf,
        /// Its width and height.
        a_size: [u32; 2],
        /// The other image.
        b: PathBuf,
        /// Its width and height.
        b_size: [u32; 2],
    },
    /// Two images with different channels were to be compared.
    #[error("{} has the channels {a_channels}, {} has {b_channels}", a.display(), b.display())]
    ChannelsDiffer {
        /// One image.
        a: PathBuf,
        /// Its channels.
        a_channels: String,
        /// The other image.
        b: PathBuf,
        /// Its channels.
        b_channels: String,
    },
    /// A bake was to be compared with an image.
    #[error("{} is a folder, {} is a file", folder.display(), file.display())]
    NotAlike {
        /// The folder.
        folder: PathBuf,
        /// The file.
        file: PathBuf,
    },
    /// The user stopped the work.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}

impl From<Unreadable> for ExportError {
    fn from(Unreadable { path, source }: Unreadable) -> ExportError {
        ExportError::Read { path, source }
    }
}

impl ExportError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        match self {
            ExportError::OutputIsFile { .. } | ExportError::OutputHasNoName { .. } => {
                Some("choose another folder with --output".to_string())
            }
            ExportError::NotABake { .. } => {
                Some("choose a new or empty folder with --output; --force replaces bakes of trodden only".to_string())
            }
            ExportError::OutputExists { .. } => {
                Some("--force replaces it; --output chooses another folder".to_string())
            }
            ExportError::OutputInUse { .. } => Some("wait for it, or choose another folder with --output".to_string()),
            ExportError::UserFile { .. } => Some("move it away, or choose another folder".to_string()),
            ExportError::InTheWay { path } => Some(format!("move {} away", path.display())),
            ExportError::Folder { source, .. } | ExportError::Write { source, .. } => write_hint(source),
            ExportError::Read { source, .. } if source.kind() == io::ErrorKind::NotFound => {
                Some("a bake is a folder with a manifest.json in it".to_string())
            }
            ExportError::NewerFormat { .. } => Some("bake again, or use the newer version of trodden".to_string()),
            ExportError::Damaged { .. } => Some("bake again, into a new folder".to_string()),
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
            Some("the disk is full: make room, or choose another disk with --output".to_string())
        }
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            Some("choose a folder that you may write to with --output".to_string())
        }
        _ => None,
    }
}
