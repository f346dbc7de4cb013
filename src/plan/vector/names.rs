//! What the names of layers, classes and blocks say, in several languages.

use crate::plan::PlanClass;

/// Stems of words by what they name, in the order in which they count: "wall hatch" is a hatch.
///
/// A stem is the beginning of a word; from four letters on also its end ("Innenwand"). A stem with `$` is the whole
/// word. Umlauts are written out, other accents are left out.
const STEMS: &[(PlanClass, &[&str])] = &[
    (
        PlanClass::Lettering,
        &[
            "text",
            "txt$",
            "label",
            "lettering",
            "iden$",
            "tags$",
            "beschrift",
            "schrift",
            "texte",
            "testo",
            "nota$",
            "notes$",
            "tekst",
            "titel",
            "legend",
            "nummer",
            "roomname",
            "文字",
            "текст",
            "注",
        ],
    ),
    (
        PlanClass::Dimension,
        &[
            "dim$",
            "dims$",
            "dimension",
            "bemass",
            "masse$",
            "masslinie",
            "cote$",
            "cotes$",
            "cotas$",
            "cota$",
            "cotation",
            "quote$",
            "quota$",
            "maatvoering",
            "wymiar",
            "grid",
            "achse",
            "axis$",
            "axes$",
            "axe$",
            "assi$",
            "ejes$",
            "raster",
            "hatch",
            "patt$",
            "schraffur",
            "hachur",
            "arrow",
            "north",
            "nord$",
            "clng$",
            "ceiling",
            "decke$",
            "lighting",
            "hvac",
            "defpoints",
            "hilfslinie",
            "centerline",
            "centreline",
            "construction",
            "overhead",
            "ovhd$",
            "尺寸",
            "轴",
            "размер",
        ],
    ),
    (
        PlanClass::Outside,
        &["outdoor", "site$", "landscape", "gelaende", "garden", "garten", "parking", "street", "strasse", "topo$"],
    ),
    (PlanClass::Lettering, &["anno$", "annotation"]),
    (PlanClass::Floor, &["indoor$"]),
    (
        PlanClass::Window,
        &[
            "window", "wndw", "glaz", "glas$", "glass", "verglas", "fenster", "fenetre", "vitr", "ventana", "finestr",
            "janela", "raam$", "ramen$", "kozijn", "okno$", "okna$", "foenster", "vindu", "窗", "окно", "окна",
        ],
    ),
    (
        PlanClass::Door,
        &[
            "door", "tuer", "porte$", "portes$", "puerta", "porta$", "portas$", "portal", "deur", "drzwi", "doerr",
            "doer$", "tor$", "tore$", "门", "門", "ドア", "двер",
        ],
    ),
    (
        PlanClass::Stairs,
        &[
            "stair",
            "strs$",
            "treppe",
            "escalier",
            "escaler",
            "scale$",
            "scala$",
            "escada",
            "trap$",
            "trappen",
            "schody",
            "trappa",
            "steps$",
            "ramp$",
            "rampe$",
            "楼梯",
            "階段",
            "лестниц",
        ],
    ),
    (
        PlanClass::Fixture,
        &[
            "sanit",
            "plumb",
            "pfix",
            "fixt",
            "wc$",
            "toilet",
            "sink",
            "basin",
            "bath",
            "badewanne",
            "dusche",
            "shower",
            "lavabo",
            "urinal",
            "bidet",
            "stove",
            "cooker",
            "卫",
        ],
    ),
    (
        PlanClass::Shelf,
        &[
            "shelf",
            "shelv",
            "schrank",
            "schraenke",
            "regal",
            "wardrobe",
            "closet",
            "bookcase",
            "armoire",
            "rack$",
            "racks$",
            "cupboard",
        ],
    ),
    (
        PlanClass::Counter,
        &[
            "counter",
            "theke",
            "reception",
            "comptoir",
            "mostrador",
            "cswk$",
            "casework",
            "millwork",
            "kitchen",
            "kueche",
        ],
    ),
    (
        PlanClass::Seat,
        &[
            "chair", "seat", "stuhl", "stuehle", "sofa", "couch", "bench", "sessel", "bed$", "beds$", "bett", "chaise",
            "silla", "sedia", "sedie", "stool",
        ],
    ),
    (
        PlanClass::Table,
        &[
            "table",
            "desk",
            "tisch",
            "furn",
            "moebel",
            "moebl",
            "mobil",
            "meubl",
            "meubel",
            "arred",
            "meble",
            "mueble",
            "inredning",
            "家具",
            "мебель",
        ],
    ),
    (
        PlanClass::Wall,
        &[
            "wall",
            "wand$",
            "wand",
            "waende",
            "mur$",
            "murs$",
            "muro",
            "muri$",
            "pared",
            "paret",
            "parede",
            "tabiq",
            "cloison",
            "muur",
            "muren",
            "scian",
            "vaegg",
            "vegg",
            "mauer",
            "partition",
            "column",
            "cols$",
            "colm",
            "stuetze",
            "saeule",
            "pillar",
            "poteau",
            "pilar",
            "pilastr",
            "parapet",
            "墙",
            "壁",
            "柱",
            "стен",
        ],
    ),
    (
        PlanClass::Frame,
        &["frame$", "border", "title", "ttlb", "plankopf", "blattrahmen", "cartouche", "sheet", "viewport", "vport"],
    ),
    (PlanClass::Floor, &["room", "space", "raum", "raeume", "floor", "flor$", "boden", "zone", "area", "slab"]),
];

/// What a name says, if it says anything known.
pub(super) fn class_of(name: &str) -> Option<PlanClass> {
    let words = words(name);
    let says = |stem: &str| match stem.strip_suffix('$') {
        Some(whole) => words.iter().any(|word| word == whole),
        None if !stem.is_ascii() => words.iter().any(|word| word.contains(stem)),
        None => words.iter().any(|word| word.starts_with(stem) || (stem.len() >= 4 && word.ends_with(stem))),
    };
    STEMS.iter().find(|(_, stems)| stems.iter().any(|stem| says(stem))).map(|(class, _)| *class)
}

/// The words of a name in small letters, without accents and without numbers at their ends.
fn words(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut before_is_small = false;
    // A name is a few words; what is longer is none.
    for letter in name.chars().take(200) {
        let starts_word = letter.is_uppercase() && before_is_small;
        before_is_small = letter.is_lowercase();
        if !letter.is_alphanumeric() || starts_word {
            words.push(String::new());
        }
        if letter.is_alphanumeric()
            && let Some(word) = words.last_mut()
        {
            for small in letter.to_lowercase() {
                match plain(small) {
                    "" => word.push(small),
                    plain => word.push_str(plain),
                }
            }
        }
    }
    words.iter().map(|word| word.trim_end_matches(|c: char| c.is_ascii_digit()).to_owned()).collect()
}

/// A letter with an accent in plain letters; "" if it has none.
fn plain(letter: char) -> &'static str {
    match letter {
        'ä' | 'æ' => "ae",
        'ö' | 'ø' => "oe",
        'ü' => "ue",
        'ß' => "ss",
        'é' | 'è' | 'ê' | 'ë' | 'ę' => "e",
        'á' | 'à' | 'â' | 'ã' | 'ą' => "a",
        'í' | 'ì' | 'î' => "i",
        'ó' | 'ò' | 'ô' | 'õ' => "o",
        'ú' | 'ù' | 'û' => "u",
        'ç' | 'ć' => "c",
        'ñ' | 'ń' => "n",
        'ś' => "s",
        'ł' => "l",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_of_several_offices_and_languages_are_told() {
        use PlanClass::*;
        for (name, class) in [
            ("A-WALL", Some(Wall)),
            ("A-WALL-PATT", Some(Dimension)),
            ("WALLS", Some(Wall)),
            ("IfcWallStandardCase", Some(Wall)),
            ("Innenwände", Some(Wall)),
            ("Wand_tragend", Some(Wall)),
            ("mur porteur", Some(Wall)),
            ("Muri", Some(Wall)),
            ("S-COLS", Some(Wall)),
            ("A-DOOR", Some(Door)),
            ("A-DOOR-IDEN", Some(Lettering)),
            ("Türen", Some(Door)),
            ("Zimmertür", Some(Door)),
            ("portes", Some(Door)),
            ("A-GLAZ", Some(Window)),
            ("Fenêtres", Some(Window)),
            ("A-FURN", Some(Table)),
            ("Office Chair 02", Some(Seat)),
            ("Wandschrank", Some(Shelf)),
            ("A-FLOR-STRS", Some(Stairs)),
            ("A-FLOR-PFIX", Some(Fixture)),
            ("A-ANNO-DIMS", Some(Dimension)),
            ("A-ANNO-NOTE", Some(Lettering)),
            ("Bemaßung", Some(Dimension)),
            ("Achsen", Some(Dimension)),
            ("grid", Some(Dimension)),
            ("IfcSpace", Some(Floor)),
            ("墙体", Some(Wall)),
            ("0", None),
            ("layer1", None),
            ("path3bed4", None),
            ("turquoise", None),
            ("", None),
        ] {
            assert_eq!(class_of(name), class, "{name}");
        }
    }
}
