//! Keeps the shape of the source: a stage knows the stages before it, no file imports a file that imports it, and no
//! file grows beyond what a reader can hold.

// A test that cannot go on fails.
#![allow(clippy::unwrap_used)]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use syn::visit::Visit;

/// Every module in the order of the data. A module may use those before it.
const ORDER: [&str; 26] = [
    "progress",
    "files",
    "options",
    "math",
    "plan",
    "walls",
    "rooms",
    "routes",
    "motion",
    "recordings",
    "formation",
    "features",
    "units",
    "crowd",
    "patterns",
    "marks",
    "stamps",
    "sums",
    "look",
    "export",
    "show",
    "scenario",
    "error",
    "source",
    "walk",
    "bake",
];
/// Longest file, lines.
const LONGEST: usize = 600;
/// Names that a caller of the library can reach. A new one replaces an old one, or says in its commit why it is needed.
const MOST_PUBLIC_NAMES: usize = 422;

/// A path of names, as `["walls", "Face"]`.
type Names = Vec<String>;

/// What a source file says about itself.
#[derive(Default)]
struct Module {
    /// Names of functions, types, constants and macros that it defines.
    defined: BTreeSet<String>,
    /// Names that `use` brings in, with the path that each stands for; `pub` ones are handed on.
    imported: BTreeMap<String, Names>,
    /// Paths that it names in code, `pub use` left out: a module that only hands a name on does not need it.
    named: Vec<Names>,
    /// Names that it shows to all who see it.
    public: Vec<String>,
}

/// Names that an item gives to a module.
fn names_of(item: &syn::Item) -> (&syn::Visibility, Vec<&syn::Ident>) {
    fn leaves<'a>(tree: &'a syn::UseTree, out: &mut Vec<&'a syn::Ident>) {
        match tree {
            syn::UseTree::Path(path) => leaves(&path.tree, out),
            syn::UseTree::Group(group) => group.items.iter().for_each(|tree| leaves(tree, out)),
            syn::UseTree::Name(name) => out.push(&name.ident),
            syn::UseTree::Rename(rename) => out.push(&rename.rename),
            syn::UseTree::Glob(_) => panic!("a public `*` hides what it shows"),
        }
    }
    match item {
        syn::Item::Mod(item) => (&item.vis, vec![&item.ident]),
        syn::Item::Fn(item) => (&item.vis, vec![&item.sig.ident]),
        syn::Item::Struct(item) => (&item.vis, vec![&item.ident]),
        syn::Item::Enum(item) => (&item.vis, vec![&item.ident]),
        syn::Item::Trait(item) => (&item.vis, vec![&item.ident]),
        syn::Item::Type(item) => (&item.vis, vec![&item.ident]),
        syn::Item::Const(item) => (&item.vis, vec![&item.ident]),
        syn::Item::Static(item) => (&item.vis, vec![&item.ident]),
        syn::Item::Use(item) if matches!(item.vis, syn::Visibility::Public(_)) => {
            let mut names = Vec::new();
            leaves(&item.tree, &mut names);
            (&item.vis, names)
        }
        _ => (&syn::Visibility::Inherited, Vec::new()),
    }
}

impl Module {
    fn parse(file: &Path) -> Module {
        let text = fs::read_to_string(file).unwrap();
        let syntax = syn::parse_file(&text).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
        let mut module = Module::default();
        module.visit_file(&syntax);
        let public = syntax.items.iter().map(names_of).filter(|(vis, _)| matches!(vis, syn::Visibility::Public(_)));
        module.public = public.flat_map(|(_, names)| names).map(ToString::to_string).collect();
        module
    }

    fn import(&mut self, tree: &syn::UseTree, before: &[String], handed_on: bool) {
        let with = |name: &syn::Ident| [before, &[name.to_string()]].concat();
        match tree {
            syn::UseTree::Path(path) => self.import(&path.tree, &with(&path.ident), handed_on),
            syn::UseTree::Group(group) => group.items.iter().for_each(|tree| self.import(tree, before, handed_on)),
            syn::UseTree::Name(name) if name.ident == "self" => self.import_as(before.to_vec(), None, handed_on),
            syn::UseTree::Name(name) => self.import_as(with(&name.ident), None, handed_on),
            syn::UseTree::Rename(rename) => {
                self.import_as(with(&rename.ident), Some(rename.rename.to_string()), handed_on);
            }
            syn::UseTree::Glob(_) => {
                self.import_as(before.to_vec(), Some(format!("{}::*", before.join("::"))), handed_on)
            }
        }
    }

    fn import_as(&mut self, path: Names, name: Option<String>, handed_on: bool) {
        self.imported.insert(name.unwrap_or_else(|| path.last().unwrap().clone()), path.clone());
        if !handed_on {
            self.named.push(path);
        }
    }

    fn define(&mut self, name: &syn::Ident) {
        self.defined.insert(name.to_string());
    }
}

fn is_test(attributes: &[syn::Attribute]) -> bool {
    let cfg = |a: &syn::Attribute| a.path().is_ident("cfg") && a.parse_args::<syn::Ident>().is_ok_and(|i| i == "test");
    attributes.iter().any(cfg)
}

impl<'a> Visit<'a> for Module {
    fn visit_item(&mut self, item: &'a syn::Item) {
        match item {
            syn::Item::Mod(module) if is_test(&module.attrs) => return,
            syn::Item::Fn(f) if is_test(&f.attrs) => return,
            syn::Item::Use(import) => {
                if !is_test(&import.attrs) {
                    let handed_on = !matches!(import.vis, syn::Visibility::Inherited);
                    self.import(&import.tree, &[], handed_on);
                }
                return;
            }
            syn::Item::Fn(item) => self.define(&item.sig.ident),
            syn::Item::Struct(item) => self.define(&item.ident),
            syn::Item::Enum(item) => self.define(&item.ident),
            syn::Item::Trait(item) => self.define(&item.ident),
            syn::Item::Type(item) => self.define(&item.ident),
            syn::Item::Const(item) => self.define(&item.ident),
            syn::Item::Static(item) => self.define(&item.ident),
            syn::Item::Macro(item) => {
                item.ident.iter().for_each(|name| self.define(name));
                // Structs of options stand within a macro.
                let tokens =
                    if item.mac.path.is_ident("options") { item.mac.tokens.to_string() } else { String::new() };
                let names = tokens.split("struct ").skip(1);
                self.defined.extend(names.map(|rest| rest.chars().take_while(|c| c.is_alphanumeric()).collect()));
            }
            _ => {}
        }
        syn::visit::visit_item(self, item);
    }

    fn visit_path(&mut self, path: &'a syn::Path) {
        if path.segments.len() > 1 {
            self.named.push(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        }
        syn::visit::visit_path(self, path);
    }
}

/// All modules of the crate, by their path.
struct Source(BTreeMap<Names, Module>);

impl Source {
    fn read() -> Source {
        let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        let modules = files_in("src").into_iter().filter_map(|file| {
            let inside = file.strip_prefix(&src).unwrap().with_extension("");
            let mut names: Names = inside.iter().map(|part| part.to_str().unwrap().to_string()).collect();
            if names.iter().any(|name| name == "tests" || name.ends_with("_tests")) {
                return None;
            }
            if ["mod", "lib"].contains(&names.last().unwrap().as_str()) {
                names.pop();
            }
            Some((names, Module::parse(&file)))
        });
        Source(modules.collect())
    }

    /// The module that defines what a path in `from` names; `None` for what other crates define.
    fn find(&self, from: &[String], path: &[String], depth: usize) -> Option<Names> {
        let (first, rest) = path.split_first()?;
        match first.as_str() {
            "crate" | "trodden" => self.find_in(Vec::new(), rest, depth),
            "self" => self.find_in(from.to_vec(), rest, depth),
            "super" => self.find_super(&from[..from.len().saturating_sub(1)], rest, depth),
            _ if self.0.contains_key(&[from, std::slice::from_ref(first)].concat()) => {
                self.find_in(from.to_vec(), path, depth)
            }
            _ => {
                let import = self.0.get(from)?.imported.get(first)?;
                (depth < 20).then(|| self.find(from, &[import, rest].concat(), depth + 1)).flatten()
            }
        }
    }

    fn find_super(&self, from: &[String], path: &[String], depth: usize) -> Option<Names> {
        match path.split_first() {
            Some((first, rest)) if first == "super" => {
                self.find_super(&from[..from.len().saturating_sub(1)], rest, depth)
            }
            _ => self.find_in(from.to_vec(), path, depth),
        }
    }

    fn find_in(&self, module: Names, path: &[String], depth: usize) -> Option<Names> {
        let Some((first, rest)) = path.split_first() else { return Some(module) };
        let child = [module.as_slice(), std::slice::from_ref(first)].concat();
        if self.0.contains_key(&child) {
            return self.find_in(child, rest, depth);
        }
        let here = self.0.get(&module)?;
        if here.defined.contains(first) {
            return Some(module);
        }
        if depth > 20 {
            return None;
        }
        if let Some(import) = here.imported.get(first) {
            return self.find(&module, &[import.as_slice(), rest].concat(), depth + 1);
        }
        let globs = here.imported.iter().filter(|(name, _)| name.ends_with('*'));
        globs.filter_map(|(_, import)| self.find(&module, &[import.as_slice(), path].concat(), depth + 1)).next()
    }

    /// Which modules each module needs.
    fn needs(&self) -> BTreeMap<&Names, BTreeSet<Names>> {
        let of = |(names, module): (&Names, &Module)| -> BTreeSet<Names> {
            let found = module.named.iter().filter_map(|path| self.find(names, path, 0));
            found.filter(|found| found != names && !found.is_empty()).collect()
        };
        self.0.iter().map(|(names, module)| (names, of((names, module)))).collect()
    }
}

fn rust_files(folder: &Path, out: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            rust_files(&path, out);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            out.push(path);
        }
    }
}

fn files_in(folder: &str) -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    rust_files(&root.join(folder), &mut files);
    files.sort();
    files
}

#[test]
fn a_stage_uses_earlier_stages_only() {
    let source = Source::read();
    let mut mistakes = Vec::new();
    for (module, needs) in source.needs() {
        let rank = |names: &Names| ORDER.iter().position(|known| *known == names[0]);
        let Some(first) = module.first().filter(|first| !["main", "cli"].contains(&first.as_str())) else { continue };
        let own = rank(module).unwrap_or_else(|| panic!("{first} has no place in ORDER"));
        for other in needs.iter().filter(|other| rank(other).is_none_or(|other| other > own)) {
            mistakes.push(format!("{} uses {}", module.join("::"), other.join("::")));
        }
    }
    assert!(mistakes.is_empty(), "{}", mistakes.join("\n"));
}

/// Files that reach each other are a ring: none of them can be read, tested or moved without the others.
#[test]
fn no_file_imports_a_file_that_imports_it() {
    let source = Source::read();
    let needs = source.needs();
    let mut reached: BTreeMap<&Names, BTreeSet<&Names>> = BTreeMap::new();
    for module in needs.keys().copied() {
        let mut found: BTreeSet<&Names> = BTreeSet::new();
        let mut open = vec![module];
        while let Some(next) = open.pop() {
            for other in needs.get(next).into_iter().flatten() {
                if found.insert(other) {
                    open.push(other);
                }
            }
        }
        reached.insert(module, found);
    }
    let mut rings: BTreeSet<BTreeSet<String>> = BTreeSet::new();
    let mut ties = Vec::new();
    for (&module, found) in reached.iter().filter(|(module, found)| found.contains(*module)) {
        let ring: Vec<_> = found.iter().filter(|other| reached[**other].contains(module)).collect();
        for other in ring.iter().filter(|other| needs[module].contains(***other)) {
            ties.push(format!("{} -> {}", module.join("::"), other.join("::")));
        }
        rings.insert(ring.iter().map(|names| names.join("::")).collect());
    }
    let shown: Vec<String> =
        rings.iter().map(|ring| format!("ring: {}", Vec::from_iter(ring.clone()).join(", "))).collect();
    assert!(rings.is_empty(), "{} rings\n{}\n{}", rings.len(), shown.join("\n"), ties.join("\n"));
}

/// What a caller sees is what the next version has to keep: a stage's entry, its options, its result, its error.
#[test]
fn the_public_surface_does_not_grow() {
    let source = Source::read();
    let (mut names, mut open) = (BTreeSet::new(), vec![Names::new()]);
    while let Some(module) = open.pop() {
        for name in &source.0[&module].public {
            let path = [module.as_slice(), std::slice::from_ref(name)].concat();
            if source.0.contains_key(&path) {
                open.push(path);
            } else {
                // The scan does not look into macros.
                let home = source.find_in(module.clone(), std::slice::from_ref(name), 0).unwrap_or(module.clone());
                names.insert(format!("{}::{name}", home.join("::")));
            }
        }
    }
    assert!(names.contains("plan::read::read") && names.contains("::Error"), "the scan misses names: {names:?}");
    let (found, most) = (names.len(), MOST_PUBLIC_NAMES);
    assert!(found <= most, "{found} public names, at most {most}; make new ones pub(crate):\n{names:#?}");
    assert!(found + 10 > most, "{found} public names: lower MOST_PUBLIC_NAMES, so that it stays so");
}

#[test]
fn the_scan_finds_what_code_names() {
    let source = Source::read();
    let find = |from: &[&str], path: &[&str]| {
        let owned = |names: &[&str]| names.iter().map(|name| name.to_string()).collect::<Names>();
        source.find(&owned(from), &owned(path), 0).map(|names| names.join("::"))
    };
    assert_eq!(find(&["bake"], &["crate", "math", "Vec2"]).as_deref(), Some("math::vector"));
    assert_eq!(find(&["math", "vector"], &["super", "SplitMix64", "new"]).as_deref(), Some("math::random"));
    assert_eq!(find(&["bake"], &["std", "fs"]), None);
    let needs = source.needs();
    let of = |name: &str| &needs[&Names::from([name.to_string()])];
    assert!(of("bake").iter().any(|names| names[0] == "show") && of("error").iter().any(|names| names[0] == "plan"));
}

/// Error types that have a remedy, and the types that each type's variants wrap.
#[derive(Default)]
struct Errors {
    with_hint: BTreeSet<String>,
    wrapped_by: BTreeMap<String, BTreeSet<String>>,
}

fn last_name(path: &syn::Type) -> Option<String> {
    let syn::Type::Path(path) = path else { return None };
    path.path.segments.last().map(|segment| segment.ident.to_string())
}

impl<'a> Visit<'a> for Errors {
    fn visit_item_enum(&mut self, item: &'a syn::ItemEnum) {
        for wrapped in item.variants.iter().flat_map(|v| &v.fields).filter_map(|field| last_name(&field.ty)) {
            self.wrapped_by.entry(wrapped).or_default().insert(item.ident.to_string());
        }
    }

    fn visit_item_impl(&mut self, item: &'a syn::ItemImpl) {
        let is_hint = |item: &syn::ImplItem| matches!(item, syn::ImplItem::Fn(f) if f.sig.ident == "hint");
        if item.items.iter().any(is_hint) {
            self.with_hint.extend(last_name(&item.self_ty));
        }
    }
}

/// `trodden::Error` finds the remedy of every error that a caller can box.
#[test]
fn no_error_with_a_remedy_is_forgotten() {
    let mut errors = Errors::default();
    for file in files_in("src") {
        errors.visit_file(&syn::parse_file(&fs::read_to_string(file).unwrap()).unwrap());
    }
    assert!(errors.with_hint.len() > 20, "{:?}", errors.with_hint);
    let gathered = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src/error.rs")).unwrap();
    let is_listed = |error: &String| gathered.contains(&format!("::{error})"));
    let is_wrapped = |error: &String| errors.wrapped_by.get(error).is_some_and(|by| by.iter().any(is_listed));
    let forgotten: Vec<_> = errors.with_hint.iter().filter(|error| !is_listed(error) && !is_wrapped(error)).collect();
    assert!(forgotten.is_empty(), "neither src/error.rs nor an error listed there names {forgotten:?}");
}

#[test]
fn no_file_is_too_long() {
    let mut long = Vec::new();
    for folder in ["src", "tests", "examples", "benches"] {
        for file in files_in(folder) {
            let lines = fs::read_to_string(&file).unwrap().lines().count();
            if lines > LONGEST {
                long.push(format!("{}: {lines} lines, at most {LONGEST}", file.display()));
            }
        }
    }
    assert!(long.is_empty(), "{}", long.join("\n"));
}

/// Callers of the library know its options; only the command line has flags.
#[test]
fn no_text_of_the_library_names_a_flag() {
    struct Texts(Vec<String>);
    impl<'a> Visit<'a> for Texts {
        fn visit_item_mod(&mut self, item: &'a syn::ItemMod) {
            if item.ident != "tests" {
                syn::visit::visit_item_mod(self, item);
            }
        }
        fn visit_attribute(&mut self, attribute: &'a syn::Attribute) {
            if let (true, Ok(list)) = (attribute.path().is_ident("error"), attribute.meta.require_list()) {
                self.0.push(list.tokens.to_string());
            }
        }
        fn visit_lit_str(&mut self, text: &'a syn::LitStr) {
            self.0.push(text.value());
        }
        fn visit_macro(&mut self, item: &'a syn::Macro) {
            self.0.push(item.tokens.to_string());
        }
    }
    let names_flag = |text: &String| {
        text.match_indices("--").any(|(at, _)| {
            let before = text[..at].chars().next_back();
            let is_start = before.is_none_or(|c| " (`\"".contains(c));
            is_start && text[at + 2..].starts_with(|c: char| c.is_ascii_lowercase())
        })
    };
    let mut naming = Vec::new();
    for file in files_in("src") {
        let path = file.display().to_string();
        if path.contains("src/cli/") || path.contains("/tests") || path.ends_with("tests.rs") {
            continue;
        }
        let mut texts = Texts(Vec::new());
        texts.visit_file(&syn::parse_file(&fs::read_to_string(&file).unwrap()).unwrap());
        naming.extend(texts.0.into_iter().filter(names_flag).map(|text| format!("{path}: {text}")));
    }
    assert!(naming.is_empty(), "{naming:#?}");
}
