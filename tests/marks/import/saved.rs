//! What is imported stands in a folder that loads.

use std::fs;
use std::path::Path;

use trodden::patterns::{
    Cause, Form, ImportEntry, ImportOptions, ImportedPattern, PatternFolder, PatternLibrary, PhotoScale, name_of_photo,
};

use super::photograph::{Scene, blot, ring};

fn imported(cause: Cause, form: Option<Form>) -> ImportedPattern {
    let scene = Scene { turned_deg: 0.0, ..Scene::of(blot()).hard() };
    let options = ImportOptions { cause, form, size: PhotoScale::PxPerCm(10.0), crop: None, rotate_deg: 0.0 };
    ImportedPattern::from_photo(&scene.photograph(), &options).unwrap()
}

fn entry(name: &str) -> ImportEntry {
    ImportEntry { name: name.to_owned(), share: None, description: "a \"drop\"\non the wall".to_owned(), force: false }
}

fn listing(folder: &Path) -> String {
    fs::read_to_string(folder.join("patterns.toml")).unwrap()
}

#[test]
fn every_cause_makes_a_folder_that_loads() {
    for cause in Cause::ALL {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path().join("new/patterns");
        let import = imported(cause, None);
        let listed = import.save(&folder, &entry("drop")).unwrap();
        assert_eq!((listed.of_cause, listed.share), (1, 1.0));
        let read = PatternFolder::read(&folder).unwrap();
        assert_eq!(read.own, 1);
        let own = &read.library.patterns[0];
        assert_eq!((own.name.as_str(), own.cause, own.share), ("drop", cause, 1.0));
        assert_eq!(own.coverage, import.coverage.as_raw().as_slice(), "{cause:?}");
        assert_eq!(own.description, "a \"drop\"\non the wall");
        assert!(read.unlisted.is_empty());
        // Nothing is missing: the rest is borrowed.
        for other in Cause::ALL {
            let has = read.library.patterns.iter().any(|pattern| pattern.cause == other);
            assert_eq!(has, !(cause == Cause::Sole && other == Cause::Heel), "{other:?} in a folder of {cause:?}");
            assert_eq!(read.borrowed.contains(&other), has && other != cause);
        }
        assert_eq!(PatternLibrary::load(&folder).unwrap().patterns.len(), read.library.patterns.len());
    }
}

#[test]
fn the_list_keeps_what_it_says() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    imported(Cause::Hand, Some(Form::Palm)).save(folder, &entry("first")).unwrap();
    let mine = listing(folder).replace("share = 1.0", "share = 0.25 # seldom") + "\n# the end";
    fs::write(folder.join("patterns.toml"), &mine).unwrap();
    let listed = imported(Cause::Hand, Some(Form::Drag)).save(folder, &entry("second")).unwrap();
    assert_eq!((listed.of_cause, listed.share), (2, 0.25));
    let text = listing(folder);
    assert!(text.starts_with(&mine), "{text}");
    imported(Cause::Arm, None).save(folder, &ImportEntry { share: Some(3.0), ..entry("third") }).unwrap();
    let library = PatternLibrary::load(folder).unwrap();
    let seen: Vec<_> = library.patterns[..3].iter().map(|p| (p.name.as_str(), p.form, p.share)).collect();
    let (palm, drag) = (Some(Form::Palm), Some(Form::Drag));
    assert_eq!(seen, [("first", palm, 0.5), ("second", drag, 0.5), ("third", None, 1.0)]);
}

#[test]
fn a_name_is_replaced_only_by_force_and_where_it_stands() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    imported(Cause::Hand, Some(Form::Palm)).save(folder, &entry("a")).unwrap();
    imported(Cause::Arm, None).save(folder, &entry("b")).unwrap();
    let (before, image) = (listing(folder), fs::read(folder.join("a.png")).unwrap());

    let error = imported(Cause::Shoe, None).save(folder, &entry("a")).unwrap_err();
    assert!(error.to_string().contains("already lists a.png"), "{error}");
    assert!(error.hint().is_some(), "{error}");
    assert_eq!((listing(folder), fs::read(folder.join("a.png")).unwrap()), (before.clone(), image));
    // A file that nobody lists is not overwritten either.
    fs::write(folder.join("c.png"), "mine").unwrap();
    assert!(imported(Cause::Shoe, None).save(folder, &entry("c")).unwrap_err().to_string().contains("exists already"));
    assert_eq!((listing(folder), fs::read(folder.join("c.png")).unwrap()), (before.clone(), b"mine".to_vec()));

    let scene = Scene::of(ring());
    let options =
        ImportOptions { cause: Cause::Arm, form: None, size: PhotoScale::PxPerCm(10.0), crop: None, rotate_deg: 0.0 };
    let other = ImportedPattern::from_photo(&scene.photograph(), &options).unwrap();
    let force = |share| ImportEntry { share, force: true, ..entry("a") };
    other.save(folder, &force(Some(0.5))).unwrap();
    let first = &PatternLibrary::load(folder).unwrap().patterns[0];
    assert_eq!((first.name.as_str(), first.cause, first.form), ("a", Cause::Arm, None));
    assert_eq!(first.length_cm, other.length_cm());
    assert_eq!(listing(folder).matches("[[pattern]]").count(), 2);
    assert!(listing(folder).contains("share = 0.5"));
    imported(Cause::Hand, Some(Form::Palm)).save(folder, &force(Some(1.0))).unwrap();
    assert_eq!(PatternLibrary::load(folder).unwrap().patterns[0].form, Some(Form::Palm));
}

#[test]
fn nothing_is_written_when_something_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let import = imported(Cause::Hand, None);
    let names = || fs::read_dir(folder).unwrap().count();
    for name in ["", "../x", "a/b", "ä", &"n".repeat(61)] {
        let error = import.save(folder, &entry(name)).unwrap_err();
        assert!(error.to_string().contains("cannot be the name") && error.hint().is_some(), "{error}");
    }
    for share in [0.0, -1.0, f64::NAN, 1e9] {
        let error = import.save(folder, &ImportEntry { share: Some(share), ..entry("x") }).unwrap_err();
        assert!(error.to_string().contains("the share is"), "{error}");
    }
    assert_eq!(names(), 0);
    for broken in ["[[pattern]", "[[pattern]]\nfile = \"a.png\"\n", "pattern = 3\n", "nonsense = 1\n"] {
        fs::write(folder.join("patterns.toml"), broken).unwrap();
        let error = import.save(folder, &entry("x")).unwrap_err();
        assert!(error.to_string().contains("patterns.toml:"), "{error}");
        assert_eq!((names(), listing(folder).as_str()), (1, broken));
    }
    // A list that lists nothing yet is one to begin with.
    fs::write(folder.join("patterns.toml"), "# my stains\n").unwrap();
    import.save(folder, &entry("x")).unwrap();
    assert!(listing(folder).starts_with("# my stains\n") && PatternLibrary::load(folder).is_ok());
}

#[test]
fn names_are_made_of_photographs() {
    for (photo, name) in
        [("a/IMG 2031.JPEG", "img_2031"), ("wand-3.png", "wand-3"), ("äöü.jpg", "stain"), ("..", "stain")]
    {
        assert_eq!(name_of_photo(Path::new(photo)), name);
    }
    assert_eq!(name_of_photo(Path::new(&"x".repeat(200))).len(), 60);
}

#[test]
fn what_lies_in_the_folder_but_is_not_listed_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    imported(Cause::Hand, None).save(folder, &entry("listed")).unwrap();
    fs::create_dir_all(folder.join("deep")).unwrap();
    for name in ["forgotten.PNG", "also.jpg", ".hidden.png", "notes.txt", "deep/photo.png"] {
        fs::write(folder.join(name), "x").unwrap();
    }
    let unlisted = PatternFolder::read(folder).unwrap().unlisted;
    assert_eq!(unlisted, [Path::new("also.jpg"), Path::new("forgotten.PNG")]);
    // Once the list takes an image from a folder below, what else lies there counts.
    fs::rename(folder.join("listed.png"), folder.join("deep/listed.png")).unwrap();
    fs::write(folder.join("patterns.toml"), listing(folder).replace("listed.png", "./deep/listed.png")).unwrap();
    let unlisted = PatternFolder::read(folder).unwrap().unlisted;
    assert_eq!(unlisted, [Path::new("also.jpg"), Path::new("deep/photo.png"), Path::new("forgotten.PNG")]);
}
