//! Writers of the building in each format, by hand: no other program is needed.

use std::fmt::Write;

use super::building::{Building, DEPTH_M, Rect, WIDTH_M};

/// How doors lie: hinge, end of the closed leaf, end of the open leaf.
pub fn leaf(door: &Rect) -> [[f64; 2]; 3] {
    let (across, middle_x, middle_y) =
        (door[2] - door[0] > door[3] - door[1], (door[0] + door[2]) * 0.5, (door[1] + door[3]) * 0.5);
    if across {
        let width = door[2] - door[0];
        [[door[0], middle_y], [door[2], middle_y], [door[0], middle_y + width]]
    } else {
        let width = door[3] - door[1];
        [[middle_x, door[1]], [middle_x, door[3]], [middle_x + width, door[1]]]
    }
}

/// An SVG in millimetres of paper at a scale, with layers as Inkscape writes them, texts, a desk a room.
pub fn svg(b: &Building, scale: f64) -> String {
    let mm = 1000.0 / scale;
    let (width, height) = ((WIDTH_M + 4.0) * mm, (DEPTH_M + 4.0) * mm);
    // The building begins 2 m from the page's lower left; y goes down.
    let at = |[x, y]: [f64; 2]| format!("{:.5},{:.5}", (x + 2.0) * mm, height - (y + 2.0) * mm);
    let rect = |r: &Rect| {
        let (w, h) = ((r[2] - r[0]) * mm, (r[3] - r[1]) * mm);
        format!(
            "x=\"{:.5}\" y=\"{:.5}\" width=\"{w:.5}\" height=\"{h:.5}\"",
            (r[0] + 2.0) * mm,
            height - (r[3] + 2.0) * mm
        )
    };
    let mut s = format!(
        "<?xml version=\"1.0\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" \
         width=\"{width}mm\" height=\"{height}mm\" viewBox=\"0 0 {width} {height}\">\n\
         <style>.wall {{ fill: #222 }} .leaf {{ fill: none; stroke: #888; stroke-width: 0.2 }}</style>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n<g inkscape:groupmode=\"layer\" inkscape:label=\"Walls\" id=\"layer1\">\n"
    );
    for (k, wall) in b.solid_walls().iter().enumerate() {
        // As rectangles, and as paths with a turn.
        if k % 2 == 0 {
            writeln!(s, "<rect class=\"wall\" {}/>", rect(wall)).unwrap();
        } else {
            let [x0, y0, x1, y1] = *wall;
            writeln!(s, "<g transform=\"translate(3 4)\"><path transform=\"translate(-3,-4)\" class=\"wall\" d=\"M{} L{} L{} L{} Z\"/></g>",
                at([x0, y0]), at([x1, y0]), at([x1, y1]), at([x0, y1])).unwrap();
        }
    }
    s.push_str("</g>\n<g inkscape:label=\"Fenster\">\n");
    for window in &b.windows {
        writeln!(s, "<rect fill=\"white\" stroke=\"blue\" stroke-width=\"0.1\" {}/>", rect(window)).unwrap();
    }
    s.push_str("</g>\n<g inkscape:label=\"Türen\">\n");
    for door in &b.doors {
        let [hinge, closed, open] = leaf(door);
        let radius = (closed[0] - hinge[0] + closed[1] - hinge[1]) * mm;
        let turns = if closed[0] > hinge[0] { 0 } else { 1 };
        writeln!(
            s,
            "<path class=\"leaf\" d=\"M{} L{} A{radius},{radius} 0 0 {} {}\"/>",
            at(hinge),
            at(open),
            1 - turns,
            at(closed)
        )
        .unwrap();
    }
    s.push_str("</g>\n<g id=\"furniture\" fill=\"none\" stroke=\"black\" stroke-width=\"0.2\">\n");
    for desk in &b.desks {
        writeln!(s, "<rect {}/>", rect(desk)).unwrap();
    }
    s.push_str("</g>\n<g id=\"dimensions\"><path stroke=\"red\" d=\"M10 10 L300 10\"/></g>\n<g id=\"rooms\">");
    for (k, room) in b.rooms.iter().enumerate() {
        write!(s, "<text x=\"{}\" y=\"5\">Office {k} 35.9 m2</text>", room[0] * mm).unwrap();
    }
    s.push_str("</g>\n</svg>\n");
    s
}

/// How a DXF draws walls.
#[derive(Clone, Copy, PartialEq)]
pub enum Walls {
    /// A closed polyline for each piece.
    Pieces,
    /// Four lines for each piece.
    Lines,
    /// Lines through the middle, the thickness not drawn.
    Centre,
}

struct Dxf(String);

impl Dxf {
    fn pairs(&mut self, pairs: &[(i32, &str)]) {
        for (code, value) in pairs {
            writeln!(self.0, "{code:>3}\n{value}").unwrap();
        }
    }

    fn numbers(&mut self, numbers: &[(i32, f64)]) {
        for (code, value) in numbers {
            writeln!(self.0, "{code:>3}\n{value:.6}").unwrap();
        }
    }

    fn line(&mut self, layer: &str, a: [f64; 2], b: [f64; 2]) {
        self.pairs(&[(0, "LINE"), (8, layer)]);
        self.numbers(&[(10, a[0]), (20, a[1]), (30, 0.0), (11, b[0]), (21, b[1]), (31, 0.0)]);
    }

    fn closed(&mut self, layer: &str, corners: &[[f64; 2]]) {
        self.pairs(&[(0, "LWPOLYLINE"), (8, layer), (90, &corners.len().to_string()), (70, "1")]);
        corners.iter().for_each(|c| self.numbers(&[(10, c[0]), (20, c[1])]));
    }
}

/// A DXF in a unit of so many metres, with the number of that unit, at a place far from the origin.
pub fn dxf(b: &Building, unit_m: f64, insunits: i32, walls: Walls, begins_m: [f64; 2]) -> String {
    let at = |[x, y]: [f64; 2]| [(x + begins_m[0]) / unit_m, (y + begins_m[1]) / unit_m];
    let corners = |r: &Rect| [[r[0], r[1]], [r[2], r[1]], [r[2], r[3]], [r[0], r[3]]].map(at);
    let mut d = Dxf(String::new());
    d.pairs(&[
        (999, "drawn by a test"),
        (0, "SECTION"),
        (2, "HEADER"),
        (9, "$INSUNITS"),
        (70, &insunits.to_string()),
        (0, "ENDSEC"),
    ]);
    d.pairs(&[
        (0, "SECTION"),
        (2, "TABLES"),
        (0, "TABLE"),
        (2, "LAYER"),
        (0, "LAYER"),
        (2, "A-WALL-DEMO"),
        (70, "0"),
        (62, "-7"),
        (0, "ENDTAB"),
        (0, "ENDSEC"),
    ]);
    // A door of one unit: hinge at the origin, opening along x, leaf along y.
    d.pairs(&[(0, "SECTION"), (2, "BLOCKS"), (0, "BLOCK"), (8, "0"), (2, "D1"), (70, "0"), (10, "0"), (20, "0")]);
    d.line("0", [0.0, 0.0], [0.0, 1.0]);
    d.pairs(&[(0, "ARC"), (8, "0"), (10, "0"), (20, "0"), (40, "1"), (50, "0"), (51, "90"), (0, "ENDBLK")]);
    d.pairs(&[(0, "BLOCK"), (8, "0"), (2, "DESK"), (70, "0"), (10, "0"), (20, "0")]);
    let (w, h) = (1.6 / unit_m, 0.8 / unit_m);
    d.line("0", [0.0, 0.0], [w, 0.0]);
    d.line("0", [w, 0.0], [w, h]);
    d.line("0", [w, h], [0.0, h]);
    d.line("0", [0.0, h], [0.0, 0.0]);
    d.pairs(&[(0, "ENDBLK"), (0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")]);
    for wall in b.solid_walls() {
        match walls {
            Walls::Pieces => d.closed("A-WALL", &corners(&wall)),
            Walls::Lines => {
                let c = corners(&wall);
                (0..4).for_each(|k| d.line("A-WALL", c[k], c[(k + 1) % 4]));
            }
            Walls::Centre => {
                let [p, q] = centre(&wall, b);
                d.line("A-WALL", at(p), at(q));
            }
        }
    }
    for window in &b.windows {
        let c = corners(window);
        d.line("A-GLAZ", c[0], c[1]);
        d.line("A-GLAZ", c[2], c[3]);
        d.line("A-GLAZ", [c[0][0], (c[0][1] + c[2][1]) * 0.5], [c[1][0], (c[0][1] + c[2][1]) * 0.5]);
    }
    for door in &b.doors {
        let [hinge, closed, open] = leaf(door);
        let hinge = at(hinge);
        let width = (closed[0] - open[0]).abs() / unit_m;
        // A leaf that opens clockwise is mirrored and turned.
        let (turn, sy) = if closed[0] > open[0] { (0.0, width) } else { (90.0, -width) };
        d.pairs(&[(0, "INSERT"), (8, "A-DOOR"), (2, "D1")]);
        d.numbers(&[(10, hinge[0]), (20, hinge[1]), (41, width), (42, sy), (50, turn)]);
    }
    for desk in &b.desks {
        let p = at([desk[0], desk[1]]);
        d.pairs(&[(0, "INSERT"), (8, "A-FURN"), (2, "DESK")]);
        d.numbers(&[(10, p[0]), (20, p[1])]);
    }
    for room in &b.rooms {
        let p = at(*room);
        d.pairs(&[(0, "TEXT"), (8, "A-WALL"), (1, "Office 35.9 m2")]);
        d.numbers(&[(10, p[0]), (20, p[1]), (40, 0.3 / unit_m)]);
        d.pairs(&[(0, "HATCH"), (8, "A-WALL"), (2, "ANSI31")]);
        d.line("A-WALL-DEMO", p, [p[0] + 2.0 / unit_m, p[1]]);
        d.line("A-ANNO-DIMS", p, [p[0] + 2.0 / unit_m, p[1]]);
        d.line("0", p, [p[0] + 2.0 / unit_m, p[1]]);
    }
    d.pairs(&[(0, "ENDSEC"), (0, "EOF")]);
    d.0
}

/// The middle line of a piece of wall. Walls that meet at the building's corners share their ends.
fn centre(wall: &Rect, b: &Building) -> [[f64; 2]; 2] {
    let (x, y) = ((wall[0] + wall[2]) * 0.5, (wall[1] + wall[3]) * 0.5);
    let o = b.outer_m * 0.5;
    let inset = |v: f64, end: f64| {
        if v == 0.0 {
            o
        } else if v == end {
            end - o
        } else {
            v
        }
    };
    if wall[2] - wall[0] > wall[3] - wall[1] {
        [[inset(wall[0], WIDTH_M), y], [inset(wall[2], WIDTH_M), y]]
    } else {
        [[x, inset(wall[1], DEPTH_M)], [x, inset(wall[3], DEPTH_M)]]
    }
}

/// An SVG of a building model's two storeys, as IfcConvert writes them at 1:100 on a paper of 1 m: the upper one is a shed.
/// Doors are cut at 1.2 m: frames and leaves, piece by piece, without swings.
pub fn svg_of_model(b: &Building) -> String {
    let at = |[x, y]: [f64; 2]| format!("{:.3},{:.3}", 300.0 + 10.0 * x, 700.0 - 10.0 * y);
    let shape = |r: &Rect| {
        let [a, b, c, d] = [[r[0], r[1]], [r[2], r[1]], [r[2], r[3]], [r[0], r[3]]].map(at);
        format!("<path d=\"M{a} L{b} L{c} L{d} L{a}\"/>\n")
    };
    let thing = |class: &str, shapes: &[Rect]| {
        let shapes: String = shapes.iter().map(shape).collect();
        format!("<g id=\"product-{class}-{}\" class=\"{class}\">\n{shapes}</g>\n", shapes.len())
    };
    let storey = |name: &str, content: String| {
        format!(
            "<g class=\"IfcBuildingStorey\" data-name=\"{name}\" \
             data-matrix3=\"[[10.000000,0.000000,300.000000],[0.000000,10.000000,700.000000],[0.0,0.0,1.0]]\">\n{content}</g>\n"
        )
    };
    let mut ground: String = b.solid_walls().iter().map(|wall| thing("IfcWall", &[*wall])).collect();
    ground.extend(b.windows.iter().map(|window| thing("IfcWindow", &[*window])));
    ground.extend(b.doors.iter().map(|door| {
        let [x0, y0, x1, y1] = *door;
        let across = x1 - x0 > y1 - y0;
        let (mx, my) = ((x0 + x1) * 0.5, (y0 + y1) * 0.5);
        let [first, last, leaf] = if across {
            [[x0, y0, x0 + 0.05, y1], [x1 - 0.05, y0, x1, y1], [x0 + 0.05, my - 0.02, x1 - 0.05, my + 0.02]]
        } else {
            [[x0, y0, x1, y0 + 0.05], [x0, y1 - 0.05, x1, y1], [mx - 0.02, y0 + 0.05, mx + 0.02, y1 - 0.05]]
        };
        thing("IfcDoor", &[first, last, leaf])
    }));
    let shed = [[0.0, 0.0, 9.0, 0.3], [0.0, 5.7, 9.0, 6.0], [0.0, 0.3, 0.3, 5.7], [8.7, 0.3, 9.0, 5.7]];
    let upper = storey("First", shed.iter().map(|wall| thing("IfcWall", &[*wall])).collect());
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"1000mm\" height=\"1000mm\" viewBox=\"0 0 1000 1000\">\n\
         <style>path {{ stroke: #222222; fill: #444444; }} .IfcDoor path {{ fill: none; }}</style>\n{}{upper}</svg>\n",
        storey("Ground", ground)
    )
}

/// A PDF at 1:100 with layers, or without and with the scale printed on it.
pub fn pdf(b: &Building, layers: bool) -> Vec<u8> {
    let pt = 72.0 / 0.0254 / 100.0;
    let at = |[x, y]: [f64; 2]| format!("{:.4} {:.4}", (x + 2.0) * pt, (y + 2.0) * pt);
    let rect = |r: &Rect| format!("{} {:.4} {:.4} re", at([r[0], r[1]]), (r[2] - r[0]) * pt, (r[3] - r[1]) * pt);
    let mut page = String::new();
    let begin = |page: &mut String, name: &str| {
        if layers {
            writeln!(page, "/OC /{name} BDC").unwrap();
        }
    };
    let end = |page: &mut String| page.push_str(if layers { "EMC\n" } else { "" });
    begin(&mut page, "L0");
    page.push_str("0.1 g\n");
    b.solid_walls().iter().for_each(|wall| writeln!(page, "{} f", rect(wall)).unwrap());
    end(&mut page);
    begin(&mut page, "L1");
    page.push_str("0.3 w 0 0 1 RG\n");
    b.windows.iter().for_each(|window| writeln!(page, "{} S", rect(window)).unwrap());
    end(&mut page);
    begin(&mut page, "L2");
    for door in &b.doors {
        let [hinge, closed, open] = leaf(door);
        // A quarter of a circle as one curve.
        let c = 0.552_284_75;
        let lerp = |a: [f64; 2], d: [f64; 2]| [open[0] + (a[0] - d[0]) * c, open[1] + (a[1] - d[1]) * c];
        let first = lerp(closed, hinge);
        let second = [closed[0] + (open[0] - hinge[0]) * c, closed[1] + (open[1] - hinge[1]) * c];
        writeln!(
            page,
            "{} m {} l S {} m {} {} {} c S",
            at(hinge),
            at(open),
            at(open),
            at(first),
            at(second),
            at(closed)
        )
        .unwrap();
    }
    end(&mut page);
    begin(&mut page, "L3");
    b.desks.iter().for_each(|desk| writeln!(page, "{} S", rect(desk)).unwrap());
    end(&mut page);
    if layers {
        // A layer that is off.
        writeln!(page, "/OC /L4 BDC 0 0 2000 20 re f EMC").unwrap();
    }
    page.push_str("BT /F1 12 Tf (Ground floor M 1:100) Tj ET\n");
    let names = ["A-WALL", "Windows", "Doors", "Furniture", "Walls, new"];
    let groups: String = (0..5).map(|k| format!("/L{k} {} 0 R ", 6 + k)).collect();
    let refs: String = (0..5).map(|k| format!("{} 0 R ", 6 + k)).collect();
    let mut objects = vec![
        format!("<< /Type /Catalog /Pages 2 0 R /OCProperties << /OCGs [{refs}] /D << /OFF [10 0 R] >> >> >>"),
        "<< /Type /Pages /Kids [3 0 R] /Count 1 >>".to_owned(),
        format!(
            "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {:.3} {:.3}] /Contents 4 0 R /Resources << /Font << /F1 5 0 R >> /Properties << {groups} >> >> >>",
            (WIDTH_M + 4.0) * pt,
            (DEPTH_M + 4.0) * pt
        ),
        format!("<< /Length {} >>\nstream\n{page}endstream", page.len()),
        "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>".to_owned(),
    ];
    objects.extend(names.map(|name| format!("<< /Type /OCG /Name ({name}) >>")));
    file_of(&objects)
}

/// A PDF file of numbered objects, the first of them its catalog.
pub fn file_of(objects: &[String]) -> Vec<u8> {
    let mut out = "%PDF-1.5\n".to_owned();
    let mut places = Vec::new();
    for (k, object) in objects.iter().enumerate() {
        places.push(out.len());
        writeln!(out, "{} 0 obj\n{object}\nendobj", k + 1).unwrap();
    }
    let start = out.len();
    writeln!(out, "xref\n0 {}\n0000000000 65535 f ", objects.len() + 1).unwrap();
    places.iter().for_each(|place| writeln!(out, "{place:010} 00000 n ").unwrap());
    writeln!(out, "trailer << /Size {} /Root 1 0 R >>\nstartxref\n{start}\n%%EOF", objects.len() + 1).unwrap();
    out.into_bytes()
}

/// An Open-RMF building in pixels of an image, y down; the building's south-west corner at (100, 900), 0.04 m a pixel.
pub fn rmf(b: &Building) -> String {
    let mut vertices: Vec<[f64; 2]> = Vec::new();
    let mut vertex = |p: [f64; 2]| {
        let close = |v: &[f64; 2]| (v[0] - p[0]).abs() < 1e-9 && (v[1] - p[1]).abs() < 1e-9;
        vertices.iter().position(close).unwrap_or_else(|| {
            vertices.push(p);
            vertices.len() - 1
        })
    };
    let mut walls = String::new();
    for wall in b.solid_walls().iter().chain(&b.windows) {
        let [p, q] = centre(wall, b);
        writeln!(walls, "      - [{}, {}, {{alpha: [3, 1], texture_name: [1, default]}}]", vertex(p), vertex(q))
            .unwrap();
    }
    let mut doors = String::new();
    for (k, door) in b.doors.iter().enumerate() {
        let [p, q] = centre(door, b);
        writeln!(doors, "      - [{}, {}, {{name: [1, door{k}], type: [1, hinged]}}]", vertex(p), vertex(q)).unwrap();
    }
    let (a, z) = (vertex([0.0, -1.0]), vertex([10.0, -1.0]));
    let (from, to) = (vertex([1.0, 9.0]), vertex([29.0, 9.0]));
    let px = |[x, y]: [f64; 2]| format!("[{}, {}, 0, \"\"]", 100.0 + x / 0.04, 900.0 - y / 0.04);
    let vertices: String = vertices.iter().map(|v| format!("      - {}\n", px(*v))).collect();
    format!(
        "coordinate_system: reference_image\nlevels:\n  L1:\n    doors:\n{doors}    drawing:\n      filename: none.png\n    \
         lanes:\n      - [{from}, {to}, {{bidirectional: [4, true]}}]\n    measurements:\n      - [{a}, {z}, {{distance: [3, 10.0]}}]\n    \
         models:\n      - {{model_name: Chair, x: 1, y: 2, yaw: 0}}\n    vertices:\n{vertices}    walls:\n{walls}lifts: {{}}\nname: office\n"
    )
}

/// A Universal VTT map: 1.5 m a square, 2 squares of margin, y down.
pub fn vtt(b: &Building) -> String {
    let square =
        |[x, y]: [f64; 2]| format!("{{\"x\": {:.6}, \"y\": {:.6}}}", x / 1.5 + 2.0, DEPTH_M / 1.5 + 2.0 - y / 1.5);
    let walls: Vec<String> = b
        .solid_walls()
        .iter()
        .chain(&b.windows)
        .map(|wall| {
            let [p, q] = centre(wall, b);
            format!("[{}, {}]", square(p), square(q))
        })
        .collect();
    let doors: Vec<String> = b
        .doors
        .iter()
        .map(|door| {
            let [p, q] = centre(door, b);
            format!("{{\"bounds\": [{}, {}], \"closed\": true}}", square(p), square(q))
        })
        .collect();
    format!(
        "{{\"format\": 0.3, \"resolution\": {{\"map_origin\": {{\"x\": 0, \"y\": 0}}, \"map_size\": {{\"x\": {}, \"y\": {}}}, \
         \"pixels_per_grid\": 70}}, \"line_of_sight\": [{}], \"portals\": [{}], \"lights\": [{{}}], \"image\": \"iVBORw0KGgo=\"}}",
        WIDTH_M / 1.5 + 4.0,
        DEPTH_M / 1.5 + 4.0,
        walls.join(","),
        doors.join(",")
    )
}
