use super::places::restore;
use super::*;

/// Returns a temporary folder and the path `out` in it.
fn place() -> (tempfile::TempDir, PathBuf) {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("out");
    (dir, out)
}

fn manifest() -> Manifest {
    Manifest::blank([10.0, 10.0])
}

/// Publishes a bake with one file of this content.
fn bake(out: &Path, content: &str, force: bool) {
    let folder = OutputFolder::begin(out, force).unwrap();
    folder.write("floor/a.txt", content.as_bytes()).unwrap();
    folder.publish(&manifest()).unwrap();
}

fn content(out: &Path) -> String {
    fs::read_to_string(out.join("floor/a.txt")).unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_published_folder_is_whole_and_nothing_else_is_left() {
    let (dir, out) = place();
    bake(&out, "1", false);
    assert_eq!(names(dir.path()), ["out"]);
    assert_eq!(names(&out), ["floor", "manifest.json"]);
    assert_eq!(Manifest::read(&out).unwrap().files, ["floor/a.txt", "manifest.json"]);
    assert!(is_bake(&out).unwrap());
}

#[test]
fn nothing_is_seen_before_it_is_published_and_nothing_is_left_if_it_is_not() {
    let (dir, out) = place();
    let folder = OutputFolder::begin(&out, false).unwrap();
    folder.write("floor/a.txt", b"1").unwrap();
    assert!(!out.exists());
    drop(folder);
    assert!(names(dir.path()).is_empty());
}

#[test]
fn parents_are_made_and_removed_again() {
    let (dir, _) = place();
    let out = dir.path().join("a/b/out");
    drop(OutputFolder::begin(&out, false).unwrap());
    assert!(names(dir.path()).is_empty());
    bake(&out, "1", false);
    assert_eq!(content(&out), "1");
}

#[test]
fn an_earlier_bake_is_replaced_only_by_force() {
    let (dir, out) = place();
    bake(&out, "1", false);
    let error = OutputFolder::begin(&out, false).unwrap_err();
    assert!(matches!(error, ExportError::OutputExists { .. }));
    assert!(error.hint().unwrap().contains("the option `force`"));
    bake(&out, "2", true);
    assert_eq!(content(&out), "2");
    assert_eq!(names(dir.path()), ["out"]);
}

#[test]
fn an_unpublished_run_leaves_the_earlier_bake_as_it_was() {
    let (dir, out) = place();
    bake(&out, "1", false);
    let folder = OutputFolder::begin(&out, true).unwrap();
    folder.write("floor/a.txt", b"2").unwrap();
    drop(folder);
    assert_eq!(content(&out), "1");
    assert_eq!(names(dir.path()), ["out"]);
}

#[test]
fn an_empty_folder_may_be_the_output() {
    let (_dir, out) = place();
    fs::create_dir(&out).unwrap();
    bake(&out, "1", false);
    assert_eq!(content(&out), "1");
}

#[test]
fn what_is_no_bake_is_never_replaced() {
    let (dir, out) = place();
    fs::create_dir(&out).unwrap();
    fs::write(out.join("holiday.jpg"), "x").unwrap();
    for other in [None, Some("{}"), Some("{\"generator\": \"else\", \"format\": 1}"), Some("trodden")] {
        if let Some(manifest) = other {
            fs::write(out.join("manifest.json"), manifest).unwrap();
        }
        for force in [false, true] {
            let error = OutputFolder::begin(&out, force).unwrap_err();
            assert!(error.to_string().contains("holiday.jpg"), "{error}");
        }
    }
    assert_eq!(names(dir.path()), ["out"]);
    assert_eq!(names(&out), ["holiday.jpg", "manifest.json"]);
}

#[test]
#[cfg(unix)]
fn a_manifest_that_the_system_refuses_to_read_is_named() {
    let (dir, out) = place();
    let old = dir.path().join(".out.old");
    bake(&out, "1", false);
    fs::remove_file(out.join(MANIFEST_NAME)).unwrap();
    // Who looks for its end gets the system's error.
    std::os::unix::fs::symlink(MANIFEST_NAME, out.join(MANIFEST_NAME)).unwrap();
    let error = OutputFolder::begin(&out, true).unwrap_err();
    assert!(error.to_string().contains("cannot read") && error.to_string().contains("out/manifest.json"), "{error}");
    assert!(matches!(error, ExportError::Folder { .. }), "{error}");
    // Nothing says whose the folder is that may be an earlier bake: it stays.
    fs::rename(&out, &old).unwrap();
    assert!(restore(&out).unwrap_err().to_string().contains(".out.old/manifest.json"));
    assert!(OutputFolder::begin(&out, true).is_err());
    assert_eq!(names(dir.path()), [".out.old"]);
    assert_eq!(content(&old), "1");
}

#[test]
fn a_file_is_no_output() {
    let (_dir, out) = place();
    fs::write(&out, "x").unwrap();
    assert!(matches!(OutputFolder::begin(&out, true), Err(ExportError::OutputIsFile { .. })));
    assert!(OutputFolder::begin(&out.join("inner"), true).is_err());
    assert_eq!(fs::read_to_string(&out).unwrap(), "x");
}

#[test]
fn a_folder_without_a_name_is_no_output() {
    assert!(OutputFolder::begin(Path::new("/"), true).is_err());
}

#[test]
fn a_read_only_folder_is_left_alone() {
    let (dir, out) = place();
    fs::create_dir(&out).unwrap();
    let set = |readonly| {
        let mut permissions = fs::metadata(&out).unwrap().permissions();
        permissions.set_readonly(readonly);
        fs::set_permissions(&out, permissions).unwrap();
    };
    set(true);
    let error = OutputFolder::begin(&out, true).unwrap_err();
    set(false);
    assert!(matches!(error, ExportError::Folder { .. }) && error.hint().is_some(), "{error}");
    assert_eq!(names(dir.path()), ["out"]);
}

#[test]
#[cfg(target_os = "linux")]
fn a_place_that_nobody_may_write_to_is_an_error() {
    // Where not even root makes folders.
    let error = OutputFolder::begin(Path::new("/proc/self/out"), false).unwrap_err();
    assert!(matches!(error, ExportError::Folder { .. }), "{error}");
}

#[test]
fn a_run_killed_between_two_renamings_is_undone() {
    let (dir, out) = place();
    bake(&out, "1", false);
    fs::rename(&out, dir.path().join(".out.old")).unwrap();
    assert!(restore(&out).unwrap());
    assert_eq!(content(&out), "1");
    // The same when the next bake begins.
    fs::rename(&out, dir.path().join(".out.old")).unwrap();
    assert!(matches!(OutputFolder::begin(&out, false), Err(ExportError::OutputExists { .. })));
    assert_eq!(content(&out), "1");
    assert!(!restore(&out).unwrap());
}

#[test]
fn a_run_killed_before_the_old_bake_was_removed_is_finished() {
    let (dir, out) = place();
    bake(&out, "2", false);
    bake(&dir.path().join("elsewhere"), "1", false);
    fs::rename(dir.path().join("elsewhere"), dir.path().join(".out.old")).unwrap();
    assert!(!restore(&out).unwrap());
    assert_eq!(names(dir.path()), ["out"]);
    assert_eq!(content(&out), "2");
}

#[test]
fn leftovers_of_a_killed_run_are_cleaned_up() {
    let (dir, out) = place();
    let new = dir.path().join(".out.new");
    for files in [&[][..], &[UNFINISHED][..], &[UNFINISHED, "half.png"][..]] {
        fs::create_dir(&new).unwrap();
        for file in files {
            fs::write(new.join(file), "").unwrap();
        }
        drop(OutputFolder::begin(&out, false).unwrap());
        assert!(names(dir.path()).is_empty());
    }
    // As if killed just before the rename.
    bake(&new, "1", false);
    bake(&out, "2", false);
    assert_eq!(names(dir.path()), ["out"]);
}

#[test]
fn somebody_elses_hidden_folder_is_left_alone() {
    let (dir, out) = place();
    let new = dir.path().join(".out.new");
    fs::create_dir(&new).unwrap();
    fs::write(new.join("diary.txt"), "x").unwrap();
    assert!(matches!(OutputFolder::begin(&out, true), Err(ExportError::InTheWay { .. })));
    assert_eq!(names(&new), ["diary.txt"]);
    let old = dir.path().join(".out.old");
    fs::rename(&new, &old).unwrap();
    bake(&out, "1", false);
    assert_eq!(names(&old), ["diary.txt"]);
}

#[test]
fn two_runs_do_not_write_the_same_output() {
    let (_dir, out) = place();
    let folder = OutputFolder::begin(&out, false).unwrap();
    assert!(matches!(OutputFolder::begin(&out, true), Err(ExportError::OutputInUse { .. })));
    folder.write("floor/a.txt", b"1").unwrap();
    folder.publish(&manifest()).unwrap();
    assert_eq!(content(&out), "1");
}

#[test]
fn kept_files_are_those_of_the_earlier_bake() {
    let (_dir, out) = place();
    bake(&out, "1", false);
    let folder = OutputFolder::begin(&out, true).unwrap();
    folder.keep(&out, &BakePath::new("floor/a.txt").unwrap()).unwrap();
    assert!(folder.create("floor/a.txt").is_err(), "it would change the earlier bake");
    assert!(matches!(folder.keep(&out, &BakePath::new("floor/b.txt").unwrap()), Err(ExportError::Read { .. })));
    folder.publish(&manifest()).unwrap();
    assert_eq!(content(&out), "1");
}

#[test]
#[cfg(unix)]
fn through_a_link_the_folder_behind_it_is_replaced() {
    let (dir, out) = place();
    let real = dir.path().join("real");
    bake(&real, "1", false);
    std::os::unix::fs::symlink(&real, &out).unwrap();
    bake(&out, "2", true);
    assert_eq!(content(&real), "2");
    assert!(out.is_symlink());
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_an_error_that_names_the_file() {
    let full = File::options().write(true).open("/dev/full").unwrap();
    let shown = PathBuf::from("out/floor/floor_mask.1001.png");
    let mut file = OutputFile { writer: BufWriter::new(full), shown };
    file.write_all(&[1; 100]).unwrap();
    let error = file.close().unwrap_err();
    assert!(error.to_string().contains("out/floor/floor_mask.1001.png"), "{error}");
    assert!(error.hint().unwrap().contains("full"), "{:?}", error.hint());
}

#[test]
fn files_of_the_user_stay_and_those_of_the_earlier_bake_go() {
    let (dir, out) = place();
    bake(&out, "1", false);
    fs::write(out.join("floor/b.txt"), "of an earlier bake").unwrap();
    let mut earlier = Manifest::read(&out).unwrap();
    earlier.files.push(BakePath::new("floor/b.txt").unwrap());
    fs::write(out.join("manifest.json"), earlier.to_json()).unwrap();
    for (name, text) in
        [("floor/mine.txt", "a"), ("notes/deep/b.md", "b"), (".DS_Store", "c"), ("floor/a.txt.import", "d")]
    {
        fs::create_dir_all(out.join(name).parent().unwrap()).unwrap();
        fs::write(out.join(name), text).unwrap();
    }
    fs::create_dir(out.join("empty")).unwrap();
    bake(&out, "2", true);
    assert_eq!(content(&out), "2");
    assert_eq!(names(dir.path()), ["out"]);
    assert_eq!(names(&out), [".DS_Store", "empty", "floor", "manifest.json", "notes"]);
    assert_eq!(names(&out.join("floor")), ["a.txt", "a.txt.import", "mine.txt"]);
    assert_eq!(fs::read_to_string(out.join("notes/deep/b.md")).unwrap(), "b");
    // The manifest lists only the bake's files.
    assert_eq!(Manifest::read(&out).unwrap().files, ["floor/a.txt", "manifest.json"]);
}

#[test]
fn a_file_of_the_user_is_never_replaced() {
    let (dir, out) = place();
    bake(&out, "1", false);
    fs::write(out.join("floor/b.txt"), "mine").unwrap();
    let folder = OutputFolder::begin(&out, true).unwrap();
    assert!(matches!(folder.check_free(&["floor/b.txt"]), Err(ExportError::UserFile { .. })));
    assert!(matches!(folder.create("floor/b.txt/c"), Err(ExportError::UserFile { .. })));
    folder.write("floor/c.txt", b"2").unwrap();
    folder.write("d", b"2").unwrap();
    // Added while the bake runs.
    fs::create_dir(out.join("d")).unwrap();
    fs::write(out.join("floor/c.txt"), "mine too").unwrap();
    let error = folder.publish(&manifest()).unwrap_err();
    assert!(error.to_string().contains("no bake has made"), "{error}");
    assert_eq!(names(dir.path()), ["out"]);
    assert_eq!(names(&out.join("floor")), ["a.txt", "b.txt", "c.txt"]);
    assert_eq!(fs::read_to_string(out.join("floor/c.txt")).unwrap(), "mine too");
}

#[test]
fn a_manifest_that_leads_out_of_the_folder_is_refused() {
    let (dir, out) = place();
    bake(&out, "1", false);
    let text = fs::read_to_string(out.join("manifest.json")).unwrap().replace("floor/a.txt", "../victim.txt");
    fs::write(out.join("manifest.json"), text).unwrap();
    fs::write(dir.path().join("victim.txt"), "v").unwrap();
    let error = OutputFolder::begin(&out, true).unwrap_err();
    assert!(error.to_string().contains("../victim.txt"), "{error}");
    assert_eq!(names(dir.path()), ["out", "victim.txt"]);
    assert!(matches!(
        OutputFolder::begin(&dir.path().join("other"), false).unwrap().create("../x"),
        Err(ExportError::NotInside(_))
    ));
}

#[test]
#[cfg(unix)]
fn links_of_the_user_stay_and_are_not_followed() {
    let (dir, out) = place();
    bake(&out, "1", false);
    let elsewhere = dir.path().join("elsewhere");
    fs::create_dir(&elsewhere).unwrap();
    fs::write(elsewhere.join("a.txt"), "mine").unwrap();
    std::os::unix::fs::symlink("../elsewhere", out.join("link")).unwrap();
    std::os::unix::fs::symlink("nowhere", out.join("floor/dangling")).unwrap();
    bake(&out, "2", true);
    assert_eq!(fs::read_to_string(out.join("link/a.txt")).unwrap(), "mine");
    assert_eq!(fs::read_link(out.join("floor/dangling")).unwrap(), Path::new("nowhere"));
    // A folder of the bake that was moved elsewhere, with a link in its place.
    fs::rename(out.join("floor"), dir.path().join("floor")).unwrap();
    std::os::unix::fs::symlink("../floor", out.join("floor")).unwrap();
    let folder = OutputFolder::begin(&out, true).unwrap();
    assert!(matches!(folder.create("floor/a.txt"), Err(ExportError::UserFile { .. })));
    let error = folder.keep(&out, &BakePath::new("floor/a.txt").unwrap()).unwrap_err();
    assert!(error.to_string().contains("leads out of the bake"), "{error}");
    drop(folder);
    assert_eq!(fs::read_to_string(dir.path().join("floor/a.txt")).unwrap(), "2");
}

#[test]
fn where_folders_cannot_be_exchanged_they_are_renamed() {
    let (dir, out) = place();
    bake(&out, "1", false);
    bake(&dir.path().join(".out.new"), "2", false);
    let places = Places::of(&out).unwrap();
    assert_eq!(places.rename_twice().unwrap().unwrap(), places.old);
    assert_eq!(content(&out), "2");
    assert_eq!(content(&places.old), "1");
    assert!(!restore(&out).unwrap());
    assert_eq!(names(dir.path()), ["out"]);
    // A folder with only a file browser's files counts as empty.
    let empty = dir.path().join("empty");
    for folder in [&empty, &dir.path().join(".empty.new")] {
        fs::create_dir(folder).unwrap();
        fs::write(folder.join(".DS_Store"), "x").unwrap();
    }
    assert!(Places::of(&empty).unwrap().rename_twice().unwrap().is_none());
    assert_eq!(names(dir.path()), ["empty", "out"]);
}

#[test]
fn readers_see_one_bake_while_others_replace_it() {
    let (_dir, out) = place();
    bake(&out, "1", false);
    let stop = std::sync::atomic::AtomicBool::new(false);
    std::thread::scope(|scope| {
        scope.spawn(|| {
            for number in 2..60 {
                let folder = OutputFolder::begin(&out, true).unwrap();
                folder.write("floor/a.txt", number.to_string().as_bytes()).unwrap();
                folder.publish(&Manifest { people: number, ..manifest() }).unwrap();
            }
            stop.store(true, std::sync::atomic::Ordering::SeqCst);
        });
        while !stop.load(std::sync::atomic::Ordering::SeqCst) {
            let read = || -> Result<(u32, String), ExportError> {
                let manifest = Manifest::read(&out)?;
                let path = manifest.files[0].within(&out)?;
                Ok((manifest.people, fs::read_to_string(&path).map_err(ExportError::read(&path))?))
            };
            let (people, text) = settled(&[&out], read).unwrap();
            assert!(text == people.to_string() || (people, text.as_str()) == (0, "1"), "{people} {text}");
        }
    });
}
