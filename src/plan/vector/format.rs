//! The vector formats of plans.

/// Start of a binary DXF file.
pub(super) const BINARY_DXF: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";
/// How much of a file tells its format, bytes.
pub(super) const HEAD_BYTES: usize = 4096;

/// A vector format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VectorFormat {
    /// Scalable Vector Graphics, plain or compressed.
    Svg,
    /// Portable Document Format with lines rather than a scan.
    Pdf,
    /// Drawing exchange file of CAD programs, as text or binary.
    Dxf,
    /// `*.building.yaml` of Open-RMF's traffic editor.
    OpenRmf,
    /// Universal VTT map of a table of games.
    Vtt,
    /// AutoCAD's own format, which is not read.
    Dwg,
    /// Building model, which is not read.
    Ifc,
}

impl VectorFormat {
    /// The format of a file that begins with these bytes, whose name, in small letters, may be empty. `None` for
    /// pictures and anything else.
    pub fn of(content: &[u8], name: &str) -> Option<VectorFormat> {
        let ends = |endings: &[&str]| endings.iter().any(|ending| name.ends_with(ending));
        let head = &content[..content.len().min(HEAD_BYTES)];
        let text = String::from_utf8_lossy(head);
        let start = text.trim_start_matches('\u{feff}').trim_start();
        let has = |words: &str| memchr::memmem::find(head, words.as_bytes()).is_some();
        // A map of a robot names an image at the start of a line, a building its levels.
        let is_building = || {
            let is_map = text.lines().any(|line| line.starts_with("image:"));
            !is_map && memchr::memmem::find(content, b"\nlevels:").is_some() && has(":")
        };
        let is_packed = head.starts_with(&[0x1f, 0x8b]) && ends(&[".svg", ".svgz", ".svg.gz"]);
        if is_packed || (start.starts_with('<') && (has("<svg") || ends(&[".svg"]))) {
            Some(VectorFormat::Svg)
        } else if memchr::memmem::find(&head[..head.len().min(1024)], b"%PDF-").is_some() {
            Some(VectorFormat::Pdf)
        } else if is_dxf(head) {
            Some(VectorFormat::Dxf)
        } else if start.starts_with("ISO-10303-21") {
            Some(VectorFormat::Ifc)
        } else if head.starts_with(b"AC10") {
            Some(VectorFormat::Dwg)
        } else if start.starts_with('{') && (ends(&[".uvtt", ".dd2vtt", ".df2vtt"]) || has("\"resolution\"")) {
            Some(VectorFormat::Vtt)
        } else if ends(&[".building.yaml", ".building.yml"]) || is_building() {
            Some(VectorFormat::OpenRmf)
        } else {
            None
        }
    }

    /// Its name for messages.
    pub(in crate::plan) fn name(self) -> &'static str {
        match self {
            VectorFormat::Svg => "SVG drawing",
            VectorFormat::Pdf => "PDF",
            VectorFormat::Dxf => "DXF drawing",
            VectorFormat::OpenRmf => "Open-RMF building",
            VectorFormat::Vtt => "Universal VTT map",
            VectorFormat::Dwg => "DWG drawing",
            VectorFormat::Ifc => "IFC model",
        }
    }

    /// What to do about a drawing that cannot be read.
    pub(in crate::plan) fn hint(self) -> &'static str {
        match self {
            VectorFormat::Dwg => "save it as DXF, for instance with the ODA File Converter or LibreCAD",
            VectorFormat::Ifc => "turn it into SVG with IfcConvert; docs/formats.md has the command",
            VectorFormat::Pdf => "choose another page by plan.page, or save the page as a PNG",
            _ => "export it again, or save it as a PNG",
        }
    }
}

/// Whether bytes are a DXF file, whatever its name.
fn is_dxf(bytes: &[u8]) -> bool {
    if bytes.starts_with(BINARY_DXF) {
        return true;
    }
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(2000)]);
    let mut lines = start.lines().map(str::trim);
    // Comments (999) may come first.
    while let (Some(code), Some(value)) = (lines.next(), lines.next()) {
        match (code, value) {
            ("999", _) => {}
            (code, value) => return code == "0" && value == "SECTION",
        }
    }
    false
}
