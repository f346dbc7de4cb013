//! `docs/manifest.schema.json` and `docs/manifest.md` are made from the types that are written; bakes of every kind keep
//! to them. `SNAPSHOTS=overwrite cargo test --test cli manifest` rewrites both.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use serde_json::{Map, Value, json};
use snapbox::{assert_data_eq, file};
use syn::{Attribute, Fields, GenericArgument, Item, PathArguments, Type};

use super::sandbox::{Sandbox, corridor};

/// What is said before the fields.
const INTRODUCTION: &str = include_str!("manifest/introduction.md");
/// Types that are written as another type.
const WRITTEN_AS: [(&str, &str); 3] = [("BakePath", "String"), ("PathBuf", "String"), ("Vec2", "[f64; 2]")];

/// A field as it is written.
struct Field {
    name: String,
    about: String,
    ty: Type,
    /// Whether it may be missing.
    optional: bool,
    /// The function that writes it in another form.
    with: Option<String>,
}

/// A type as it is written: an object, or one of some names, some with content.
enum Written {
    Object(String, Vec<Field>),
    OneOf { untagged: bool, ways: Vec<(String, Content)> },
}

/// What a variant holds.
enum Content {
    Nothing,
    One(Type),
    Object(Vec<Field>),
}

/// All types of the library that are written, by name.
struct Types(BTreeMap<String, Written>);

impl Types {
    fn of_source() -> Types {
        let mut types = Types(BTreeMap::new());
        types.collect(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"));
        types
    }

    fn collect(&mut self, folder: &Path) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                self.collect(&path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                let file = syn::parse_file(&fs::read_to_string(&path).unwrap()).unwrap();
                file.items.iter().for_each(|item| self.add(item));
            }
        }
    }

    fn add(&mut self, item: &Item) {
        let written = |attributes: &[Attribute]| {
            let derives = attributes.iter().filter(|a| a.path().is_ident("derive"));
            derives.map(|a| a.meta.require_list().unwrap().tokens.to_string()).any(|names| names.contains("Serialize"))
        };
        let (name, found) = match item {
            Item::Struct(item) if written(&item.attrs) => {
                let Fields::Named(fields) = &item.fields else { return };
                let fields =
                    fields.named.iter().filter(|field| !serde_has(&field.attrs, "skip")).map(Field::of).collect();
                (&item.ident, Written::Object(docs(&item.attrs), fields))
            }
            Item::Enum(item) if written(&item.attrs) => {
                let kebab = serde_value(&item.attrs, "rename_all").is_some_and(|case| case == "kebab-case");
                let snake = serde_value(&item.attrs, "rename_all").is_some_and(|case| case == "snake_case");
                let named = |variant: &syn::Variant| {
                    let name = match (kebab, snake) {
                        (true, _) => split(&variant.ident.to_string(), '-'),
                        (_, true) => split(&variant.ident.to_string(), '_'),
                        _ => variant.ident.to_string().to_lowercase(),
                    };
                    let content = match &variant.fields {
                        Fields::Unit => Content::Nothing,
                        Fields::Unnamed(fields) => Content::One(fields.unnamed[0].ty.clone()),
                        Fields::Named(fields) => Content::Object(fields.named.iter().map(Field::of).collect()),
                    };
                    (name, content)
                };
                let ways = item.variants.iter().map(named).collect();
                (&item.ident, Written::OneOf { untagged: serde_has(&item.attrs, "untagged"), ways })
            }
            _ => return,
        };
        self.0.insert(name.to_string(), found);
    }

    /// The schema of a type; objects with names become definitions.
    fn schema(&self, ty: &Type, definitions: &mut Map<String, Value>) -> Value {
        let (name, inner) = parts(ty);
        let mut of = |inner: &Type| self.schema(inner, definitions);
        match name.as_str() {
            "f64" => json!({ "type": "number" }),
            "u32" | "u64" | "usize" => json!({ "type": "integer", "minimum": 0 }),
            "bool" => json!({ "type": "boolean" }),
            "String" => json!({ "type": "string" }),
            "Value" => json!({ "type": "object" }),
            "Option" => json!({ "anyOf": [of(&inner[0]), { "type": "null" }] }),
            "Vec" => json!({ "type": "array", "items": of(&inner[0]) }),
            "BTreeMap" => json!({ "type": "object", "additionalProperties": of(&inner[1]) }),
            "(" => {
                let items: Vec<Value> = inner.iter().map(of).collect();
                json!({ "type": "array", "items": items, "minItems": inner.len(), "maxItems": inner.len() })
            }
            "[" => {
                let count = length(ty);
                json!({ "type": "array", "items": of(&inner[0]), "minItems": count, "maxItems": count })
            }
            name => {
                let written = self.0.get(name).unwrap_or_else(|| panic!("no type {name} is written"));
                if !definitions.contains_key(name) {
                    definitions.insert(name.to_string(), Value::Null);
                    let schema = self.definition(written, definitions);
                    definitions.insert(name.to_string(), schema);
                }
                json!({ "$ref": format!("#/definitions/{name}") })
            }
        }
    }

    fn definition(&self, written: &Written, definitions: &mut Map<String, Value>) -> Value {
        match written {
            Written::Object(about, fields) => {
                let mut object = self.object(fields, definitions);
                object["description"] = json!(about);
                object
            }
            Written::OneOf { untagged, ways } => {
                let plain: Vec<&String> = ways
                    .iter()
                    .filter(|(_, content)| matches!(content, Content::Nothing))
                    .map(|(name, _)| name)
                    .collect();
                let mut schemas: Vec<Value> = Vec::new();
                if !plain.is_empty() {
                    schemas.push(json!({ "enum": plain }));
                }
                for (name, content) in ways {
                    let content = match content {
                        Content::Nothing => continue,
                        Content::One(ty) => self.schema(ty, definitions),
                        Content::Object(fields) => self.object(fields, definitions),
                    };
                    let tagged = json!({ "type": "object", "properties": { name: content }, "required": [name] });
                    schemas.push(if *untagged { tagged["properties"][name].clone() } else { tagged });
                }
                if schemas.len() == 1 { schemas.remove(0) } else { json!({ "anyOf": schemas }) }
            }
        }
    }

    fn object(&self, fields: &[Field], definitions: &mut Map<String, Value>) -> Value {
        let required: Vec<&String> = fields.iter().filter(|field| !field.optional).map(|field| &field.name).collect();
        let properties: Map<String, Value> =
            fields.iter().map(|field| (field.name.clone(), self.field(field, definitions))).collect();
        json!({ "type": "object", "properties": properties, "required": required })
    }

    fn field(&self, field: &Field, definitions: &mut Map<String, Value>) -> Value {
        let schema = match field.with.as_deref() {
            Some("one_or_many" | "super::one_or_many") => {
                json!({ "anyOf": [{ "type": "string" }, { "type": "array", "items": { "type": "string" } }] })
            }
            Some("crate::options::kept") => json!({ "type": "object" }),
            Some(with) => panic!("`{}` is written by {with}", field.name),
            None => self.schema(field.content(), definitions),
        };
        // In draft 7 a `$ref` hides what stands beside it.
        let mut schema = if schema.get("$ref").is_some() { json!({ "allOf": [schema] }) } else { schema };
        schema["description"] = json!(field.about);
        schema
    }

    /// What a document calls a type; and the object in it, if it has one.
    fn told(&self, ty: &Type) -> (String, Option<String>) {
        if matches!(ty, Type::Path(path) if path.path.is_ident("Vec2")) {
            return ("[x, y]".to_string(), None);
        }
        let (name, inner) = parts(ty);
        match name.as_str() {
            "f64" => ("number".to_string(), None),
            "u32" | "u64" | "usize" => ("whole number".to_string(), None),
            "bool" => ("true or false".to_string(), None),
            "String" => ("text".to_string(), None),
            "Value" => ("object".to_string(), None),
            "Option" => {
                let (told, object) = self.told(&inner[0]);
                (format!("{told}, or null"), object)
            }
            "Vec" => {
                let (told, object) = self.told(&inner[0]);
                (format!("list: {told}"), object)
            }
            "BTreeMap" => {
                let (told, object) = self.told(&inner[1]);
                (format!("object: {told} by name"), object)
            }
            "(" => {
                let each: Vec<String> = inner.iter().map(|ty| self.told(ty).0).collect();
                (format!("[{}]", each.join(", ")), None)
            }
            "[" => {
                let (told, object) = self.told(&inner[0]);
                (format!("{} of: {told}", length(ty)), object)
            }
            name => match &self.0[name] {
                Written::Object(..) => ("object".to_string(), Some(name.to_string())),
                Written::OneOf { untagged, ways } => {
                    let inside = |content: &Content| match content {
                        Content::Nothing => String::new(),
                        Content::One(ty) => self.told(ty).0,
                        Content::Object(fields) => {
                            let names: Vec<String> = fields.iter().map(|field| format!("`{}`", field.name)).collect();
                            format!("{{ {} }}", names.join(", "))
                        }
                    };
                    let each: Vec<String> = ways
                        .iter()
                        .map(|(name, content)| match content {
                            Content::Nothing => format!("`{name}`"),
                            content if *untagged => inside(content),
                            content => format!("{{ `{name}`: {} }}", inside(content)),
                        })
                        .collect();
                    (each.join(" or "), None)
                }
            },
        }
    }

    /// A table of the fields of an object, and after it those of the objects in it. `known` are those that have one.
    fn tables(&self, name: &str, path: &str, known: &mut Vec<(String, String)>, text: &mut String) {
        let Written::Object(about, fields) = &self.0[name] else { return };
        known.push((name.to_string(), path.to_string()));
        writeln!(text, "\n## `{path}`\n\n{about}\n\n| field | type | |\n|---|---|---|").unwrap();
        let mut below = Vec::new();
        for field in fields {
            let own_form = field.with.is_some();
            let (told, object) = if own_form { ("see there".to_string(), None) } else { self.told(field.content()) };
            let inside = format!("{path}.{}", field.name);
            let place =
                known.iter().chain(&below).find(|(name, _)| Some(name) == object.as_ref()).map(|(_, path)| path);
            let at = place.unwrap_or(&inside).replace('.', "");
            let told = if object.is_some() { format!("[{told}](#{})", at) } else { told };
            let missing = if field.optional { " *May be missing.*" } else { "" };
            writeln!(text, "| `{}` | {told} | {}{missing} |", field.name, field.about).unwrap();
            if let (Some(object), None) = (object, place) {
                below.push((object, inside));
            }
        }
        for (object, inside) in below {
            if !known.iter().any(|(name, _)| *name == object) {
                self.tables(&object, &inside, known, text);
            }
        }
    }
}

impl Field {
    fn of(field: &syn::Field) -> Field {
        let name = serde_value(&field.attrs, "rename").unwrap_or_else(|| field.ident.as_ref().unwrap().to_string());
        Field {
            name: name.trim_start_matches("r#").to_string(),
            about: docs(&field.attrs),
            ty: field.ty.clone(),
            optional: serde_value(&field.attrs, "skip_serializing_if").is_some(),
            with: serde_value(&field.attrs, "with"),
        }
    }

    /// Its type, if it is there.
    fn content(&self) -> &Type {
        let Type::Path(path) = &self.ty else { return &self.ty };
        match &path.path.segments.last().unwrap().arguments {
            PathArguments::AngleBracketed(inner) if self.optional && parts(&self.ty).0 == "Option" => {
                let Some(GenericArgument::Type(ty)) = inner.args.first() else { return &self.ty };
                ty
            }
            _ => &self.ty,
        }
    }
}

/// The name of a type and the types in it; `[` and `(` for arrays and tuples.
fn parts(ty: &Type) -> (String, Vec<Type>) {
    match ty {
        Type::Array(array) => ("[".to_string(), vec![(*array.elem).clone()]),
        Type::Tuple(tuple) => ("(".to_string(), tuple.elems.iter().cloned().collect()),
        Type::Path(path) => {
            let last = path.path.segments.last().unwrap();
            let name = last.ident.to_string();
            if let Some((_, other)) = WRITTEN_AS.iter().find(|(own, _)| *own == name) {
                return parts(&syn::parse_str(other).unwrap());
            }
            let PathArguments::AngleBracketed(inner) = &last.arguments else { return (name, vec![]) };
            let types = inner.args.iter().filter_map(|argument| match argument {
                GenericArgument::Type(ty) => Some(ty.clone()),
                _ => None,
            });
            (name, types.collect())
        }
        _ => panic!("a type of a kind that is not written"),
    }
}

/// Number of items of an array.
fn length(ty: &Type) -> usize {
    match ty {
        Type::Array(array) => match &array.len {
            syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Int(count), .. }) => count.base10_parse().unwrap(),
            _ => panic!("an array's length is a number"),
        },
        // The only type that is written as an array.
        _ => 2,
    }
}

/// The text of a serde attribute, such as `rename`.
fn serde_value(attributes: &[Attribute], key: &str) -> Option<String> {
    let mut found = None;
    for attribute in attributes.iter().filter(|attribute| attribute.path().is_ident("serde")) {
        let _ = attribute.parse_nested_meta(|meta| {
            let value = meta.value().and_then(|value| value.parse::<syn::LitStr>());
            if let (true, Ok(text)) = (meta.path.is_ident(key), value) {
                found = Some(text.value());
            }
            Ok(())
        });
    }
    found
}

/// Whether the serde attributes have a word without a value, such as `skip`.
fn serde_has(attributes: &[Attribute], word: &str) -> bool {
    let mut found = false;
    for attribute in attributes.iter().filter(|attribute| attribute.path().is_ident("serde")) {
        let _ = attribute.parse_nested_meta(|meta| {
            found |= meta.path.is_ident(word);
            Ok(())
        });
    }
    found
}

/// The doc comment as one line, without links into the source.
fn docs(attributes: &[Attribute]) -> String {
    let lines = attributes.iter().filter(|attribute| attribute.path().is_ident("doc")).map(|attribute| {
        let syn::Meta::NameValue(pair) = &attribute.meta else { panic!("a doc comment is a text") };
        let syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(text), .. }) = &pair.value else { panic!("a text") };
        text.value().trim().to_string()
    });
    let text = lines.filter(|line| !line.is_empty()).collect::<Vec<_>>().join(" ");
    text.replace("[`", "`").replace("`]", "`").replace('|', "\\|")
}

/// `StandingPeople` as `standing-people`.
fn split(name: &str, between: char) -> String {
    let mut text = String::new();
    for (k, letter) in name.char_indices() {
        if letter.is_uppercase() && k > 0 {
            text.push(between);
        }
        text.extend(letter.to_lowercase());
    }
    text
}

fn schema() -> Value {
    let types = Types::of_source();
    let mut definitions = Map::new();
    types.schema(&syn::parse_str("Manifest").unwrap(), &mut definitions);
    types.schema(&syn::parse_str("Report").unwrap(), &mut definitions);
    json!({
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "manifest.json of a bake of trodden; report.json is #/definitions/Report",
        "$ref": "#/definitions/Manifest",
        "definitions": definitions,
    })
}

#[test]
fn the_schema_and_the_page_of_the_manifest_are_those_of_the_types() {
    let mut json = serde_json::to_string_pretty(&schema()).unwrap();
    json.push('\n');
    assert_data_eq!(json, file!["../../docs/manifest.schema.json"].raw());
    let (types, mut text) = (Types::of_source(), INTRODUCTION.to_string());
    let mut known = Vec::new();
    types.tables("Manifest", "manifest", &mut known, &mut text);
    types.tables("Report", "report", &mut known, &mut text);
    assert_data_eq!(text, file!["../../docs/manifest.md"].raw());
}

/// The places at which a value breaks a schema. A key that the schema does not name breaks it too.
fn broken(value: &Value, schema: &Value, root: &Value, at: &str) -> Vec<String> {
    if let Some(name) = schema["$ref"].as_str() {
        return broken(value, root.pointer(&name[1..]).unwrap(), root, at);
    }
    if let Some(ways) = schema["anyOf"].as_array() {
        let each: Vec<Vec<String>> = ways.iter().map(|way| broken(value, way, root, at)).collect();
        return each.into_iter().min_by_key(Vec::len).unwrap();
    }
    if let Some(all) = schema["allOf"].as_array() {
        return all.iter().flat_map(|one| broken(value, one, root, at)).collect();
    }
    if let Some(names) = schema["enum"].as_array() {
        return if names.contains(value) { vec![] } else { vec![format!("{at}: {value} is not one of {names:?}")] };
    }
    let fits = match schema["type"].as_str().unwrap() {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "null" => value.is_null(),
        "integer" => value.is_u64(),
        "number" => value.is_number(),
        other => panic!("{other}"),
    };
    if !fits {
        return vec![format!("{at}: {value} is no {}", schema["type"])];
    }
    let mut found = Vec::new();
    if let Some(list) = value.as_array() {
        let count = list.len() as u64;
        if schema["minItems"].as_u64().is_some_and(|least| count < least)
            || schema["maxItems"].as_u64().is_some_and(|most| count > most)
        {
            found.push(format!("{at} has {count} items"));
        }
        for (k, item) in list.iter().enumerate() {
            let items = schema["items"].get(k).unwrap_or(&schema["items"]);
            found.extend(broken(item, items, root, &format!("{at}[{k}]")));
        }
    }
    let Some(object) = value.as_object() else { return found };
    for name in schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str) {
        if !object.contains_key(name) {
            found.push(format!("{at}.{name} is missing"));
        }
    }
    let free = schema.get("properties").is_none();
    for (name, item) in object {
        let at = format!("{at}.{name}");
        match schema["properties"].get(name).or(schema.get("additionalProperties")) {
            Some(schema) => found.extend(broken(item, schema, root, &at)),
            None if free => {}
            None => found.push(format!("{at} is not in the schema")),
        }
    }
    found
}

#[test]
fn manifests_and_reports_of_every_kind_of_bake_keep_to_the_schema() {
    let root = schema();
    let sandbox = Sandbox::new();
    sandbox.plan();
    let paths: String = (0..80).map(|k| format!("1 {k} {:.2} 2.0 0\n", 0.6 + 0.08 * f64::from(k))).collect();
    sandbox.write("paths.txt", format!("# framerate: 10.00\n# id frame x/m y/m z/m\n{paths}"));
    let people = |rest: &str| {
        format!(
            "[plan]\nimage = \"plan.png\"\nmetres_per_pixel = 0.1\n[texture]\nwall_texels_per_metre = 10\n[crowd]\npeople = 6\n{rest}"
        )
    };
    sandbox.write(
        "stops.toml",
        people("")
            + "days = 2\narrivals = { kind = \"bursts\", every_s = 20.0, people = 3 }\n\
        [[stop]]\nname = \"desk\"\nkind = \"machine\"\nat = [4.0, 2.0]\n",
    );
    sandbox.write("plan.toml", people(""));
    sandbox.write("tiles.toml", people("").replace("[crowd]", "tile = 64\n[crowd]"));
    sandbox.write("seen.toml", people("") + "[motion]\nfile = \"paths.txt\"\n");
    let mut rooms = corridor();
    for (x, y) in (38..42).flat_map(|x| (5..35).filter(|y| !(15..25).contains(y)).map(move |y| (x, y))) {
        rooms.put_pixel(x, y, image::Luma([0]));
    }
    rooms.save(sandbox.path("rooms.png")).unwrap();
    let door =
        people("preset = \"wet\"\n[[door]]\nat = [4.0, 2.0]\nhinge = [4.0, 1.5]\n").replace("plan.png", "rooms.png");
    sandbox.write("door.toml", door);
    let bursts = people("arrivals = { kind = \"bursts\", every_s = 20.0, people = 300 }\n");
    sandbox.write("crowded.toml", bursts.replace("plan.png", "rooms.png"));
    (5..35).for_each(|y| rooms.put_pixel(79, y, image::Luma([0])));
    rooms.save(sandbox.path("home.png")).unwrap();
    sandbox.write("home.toml", people("").replace("plan.png", "home.png"));
    let museum = format!("{}/floorplans/museum.toml", env!("CARGO_MANIFEST_DIR"));
    let bakes: [(&str, &[&str]); 9] = [
        ("usual", &["plan.toml"]),
        ("floor", &["plan.toml", "--floor-only"]),
        ("stops", &["stops.toml"]),
        ("seen", &["seen.toml"]),
        ("unity", &["door.toml", "--target", "unity", "--layers"]),
        ("unreal", &["tiles.toml", "--target", "unreal"]),
        ("museum", &[&museum, "--people", "20", "--floor-only"]),
        ("home", &["home.toml", "--floor-only"]),
        ("crowded", &["crowded.toml", "--people", "300", "--floor-only"]),
    ];
    let mut seen = String::new();
    for (name, arguments) in bakes {
        let usual = ["bake", "--quiet", "--texels-per-metre", "10", "--output", name];
        sandbox.run(&[&usual, arguments].concat()).succeeds();
        let read = |file: &str| -> Value {
            serde_json::from_slice(&fs::read(sandbox.path(name).join(file)).unwrap()).unwrap()
        };
        let (manifest, report) = (read("manifest.json"), read("report.json"));
        assert_eq!(broken(&manifest, &root, &root, name), [""; 0]);
        assert_eq!(broken(&report, &root["definitions"]["Report"], &root, name), [""; 0]);
        seen += &(manifest.to_string() + &report.to_string());
    }
    // The schema is held against what it describes: all fields were seen but those of units, which need a large crowd, and
    // of people who got stuck.
    let definitions = root["definitions"].as_object().unwrap().iter();
    let fields = definitions.flat_map(|(_, schema)| schema["properties"].as_object().into_iter().flat_map(Map::keys));
    let unseen: Vec<&String> = fields.filter(|field| !seen.contains(&format!("\"{field}\":"))).collect();
    assert!(unseen.len() <= 32, "not seen: {unseen:?}");

    let mut manifest: Value =
        serde_json::from_slice(&fs::read(sandbox.path("usual").join("manifest.json")).unwrap()).unwrap();
    manifest["floor"]["tile_px"] = json!([64]);
    manifest["floor"]["naming"] = json!("rows");
    manifest["floor"]["tiles"][0]["colour"] = json!("blue");
    manifest.as_object_mut().unwrap().remove("seed");
    assert_eq!(broken(&manifest, &root, &root, "manifest").len(), 4);
}
