//! Damaged and hostile drawings end in an error or in a plan, soon, and never in a panic.

use trodden::plan::{PlanError, PlanOptions};

use super::building::Building;
use super::measure::read_with;
use super::write::{self, Walls};

fn error(name: &str, bytes: impl AsRef<[u8]>) -> String {
    let error = read_with(name, bytes, &PlanOptions::default()).expect_err(name);
    assert!(error.hint().is_some() || !matches!(error, PlanError::Drawing { .. }), "{error}");
    error.to_string()
}

#[test]
fn drawings_cut_anywhere() {
    let b = Building::new(0.3, 0.12);
    let files: [(&str, Vec<u8>); 5] = [
        ("a.svg", write::svg(&b, 100.0).into_bytes()),
        ("a.dxf", write::dxf(&b, 0.001, 4, Walls::Pieces, [0.0; 2]).into_bytes()),
        ("a.pdf", write::pdf(&b, true)),
        ("a.building.yaml", write::rmf(&Building::new(0.1, 0.1)).into_bytes()),
        ("a.uvtt", write::vtt(&Building::new(0.1, 0.1)).into_bytes()),
    ];
    for (name, bytes) in files {
        for share in [1, 5, 10, 20, 35, 50, 65, 80, 95] {
            // Either is fine.
            let _ = read_with(name, &bytes[..bytes.len() * share / 100], &PlanOptions::default());
        }
        for step in [97, 331] {
            let mut spoiled = bytes.clone();
            spoiled.iter_mut().skip(60).step_by(step).for_each(|byte| *byte = b'9');
            let _ = read_with(name, spoiled, &PlanOptions::default());
        }
    }
}

#[test]
fn svg_bombs() {
    let entities: String =
        (1..20).map(|k| format!("<!ENTITY e{k} \"{}\">", format!("&e{};", k - 1).repeat(10))).collect();
    let bomb = format!(
        "<?xml version=\"1.0\"?><!DOCTYPE svg [<!ENTITY e0 \"<g/>\">{entities}]><svg xmlns=\"http://www.w3.org/2000/svg\">&e19;</svg>"
    );
    error("bomb.svg", bomb);
    let uses: String =
        (1..30).map(|k| format!("<g id=\"u{k}\">{}</g>", format!("<use href=\"#u{}\"/>", k - 1).repeat(10))).collect();
    let bomb = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9\" height=\"9\"><rect id=\"u0\" width=\"1\" height=\"1\"/>{uses}</svg>"
    );
    error("uses.svg", bomb);
    let deep = format!("<svg xmlns=\"http://www.w3.org/2000/svg\">{}{}</svg>", "<g>".repeat(5000), "</g>".repeat(5000));
    error("deep.svg", deep);
    assert!(error("none.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>").contains("cannot be used"));
    assert!(error("other.svg", "<html><svg></svg></html>").contains("<html>"));
}

#[test]
fn dxf_blocks_that_hold_themselves_and_rows_without_end() {
    let block = |name: &str, inside: &str| {
        format!(
            "0\nBLOCK\n2\n{name}\n0\nLINE\n8\nWALLS\n11\n5\n0\nINSERT\n2\n{inside}\n70\n9999\n71\n9999\n0\nENDBLK\n"
        )
    };
    let file = |blocks: &str| {
        format!(
            "0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nINSERT\n2\nA\n0\nENDSEC\n0\nEOF\n"
        )
    };
    // A room needs more than one line: an error, but soon.
    error("ring.dxf", file(&(block("A", "B") + &block("B", "A"))));
    assert!(error("rows.dxf", file(&(block("A", "B") + &block("B", "C") + &block("C", "none")))).contains("more"));
}

#[test]
fn absurd_numbers() {
    for number in ["nan", "inf", "1e300", "-1e308", "99999999999", "x"] {
        let dxf = format!(
            "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\nWALL\n10\n{number}\n20\n0\n11\n{number}\n21\n5\n0\nCIRCLE\n8\nWALL\n40\n{number}\n0\nSPLINE\n8\nWALL\n71\n3\n40\n{number}\n10\n1\n20\n{number}\n0\nENDSEC\n"
        );
        let _ = read_with("a.dxf", dxf, &PlanOptions::default());
        let json = format!(
            "{{\"resolution\": {{\"map_size\": {{\"x\": {number}, \"y\": 3}}}}, \"line_of_sight\": [[{{\"x\": 1, \"y\": {number}}}, {{\"x\": 2, \"y\": 2}}]]}}"
        );
        let _ = read_with("a.uvtt", json, &PlanOptions::default());
        let yaml = format!(
            "levels:\n  L1:\n    vertices:\n      - [{number}, 1, 0, a]\n      - [2, {number}, 0, b]\n    walls:\n      - [0, 1, {{}}]\n      - [0, {number}, {{}}]\n    measurements:\n      - [0, 1, {{distance: [3, {number}]}}]\n"
        );
        let _ = read_with("a.building.yaml", yaml, &PlanOptions::default());
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{number}mm\" height=\"5mm\"><g id=\"walls\"><rect width=\"{number}\" height=\"1\"/><path d=\"M0 0 L{number} 5\" stroke=\"black\" stroke-width=\"{number}\"/></g></svg>"
        );
        let _ = read_with("a.svg", svg, &PlanOptions::default());
        let page = format!("0 g {number} 0 0 1 0 0 cm {number} w 0 0 {number} 10 re f 0 0 m {number} {number} l S");
        let objects = [
            "<< /Type /Catalog /Pages 2 0 R >>".to_owned(),
            "<< /Type /Pages /Kids [3 0 R] /Count 1 >>".to_owned(),
            "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 500 500] /Contents 4 0 R >>".to_owned(),
            format!("<< /Length {} >>\nstream\n{page}\nendstream", page.len() + 1),
        ];
        let _ = read_with("a.pdf", write::file_of(&objects), &PlanOptions::default());
    }
}

#[test]
fn a_pdf_form_that_draws_itself() {
    let objects = [
        "<< /Type /Catalog /Pages 2 0 R >>".to_owned(),
        "<< /Type /Pages /Kids [3 0 R] /Count 1 >>".to_owned(),
        "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 500 500] /Contents 4 0 R /Resources << /XObject << /X 5 0 R >> >> >>".to_owned(),
        "<< /Length 5 >>\nstream\n/X Do\nendstream".to_owned(),
        "<< /Type /XObject /Subtype /Form /BBox [0 0 500 500] /Resources << /XObject << /X 5 0 R >> >> /Length 30 >>\nstream\n/X Do /X Do 0 0 m 9 9 l S /X Do\nendstream".to_owned(),
    ];
    // The scale need not be found: nothing is drawn but a line.
    let options = PlanOptions { metres_per_pixel: Some(0.05), ..PlanOptions::default() };
    let _ = read_with("a.pdf", write::file_of(&objects), &options);
}

#[test]
fn files_of_formats_that_are_not_read_say_what_to_do() {
    assert!(error("model.ifc", "ISO-10303-21;\nHEADER;").contains("IFC"));
    assert!(error("plan.dwg", "AC1032\0\0\0").contains("DWG"));
    assert!(error("empty.dxf", "0\nSECTION\n2\nENTITIES\n0\nENDSEC\n").contains("no shapes"));
    assert!(error("scan.pdf", "%PDF-1.4\nnothing").contains("PDF"));
    assert!(error("none.uvtt", "{\"resolution\": {\"map_size\": {\"x\": 5, \"y\": 5}}}").contains("line_of_sight"));
    let wanted = PlanOptions { page: Some(3), ..PlanOptions::default() };
    let refused = read_with("a.pdf", write::pdf(&Building::new(0.3, 0.12), true), &wanted).unwrap_err().to_string();
    assert!(refused.contains("page 3 was asked for; it has 1"), "{refused}");
}
