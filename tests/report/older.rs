//! Pages of folders that an older version wrote: they show what the files allow, and name what
//! these lack.
use crate::command::said;
use crate::text::{data, forget_records};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// The file `name` in `folder`, changed.
fn change(folder: &Path, name: &str, change: impl FnOnce(&mut Value)) {
    let path = folder.join(name);
    let mut document: Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    change(&mut document);
    fs::write(path, document.to_string()).unwrap();
}

/// The data of the page of the results in `folder`, made again.
fn page(folder: &Path) -> Value {
    said(folder, &["report", "."], 0);
    data(&fs::read_to_string(folder.join("report.html")).unwrap())
}

/// The walls of a summary.
fn walls(summary: &mut Value) -> impl Iterator<Item = &mut Value> {
    summary["statistics"]["walls"].as_array_mut().unwrap().iter_mut()
}

#[test]
fn the_largest_force_of_an_older_run_is_that_of_its_statistics_or_named_as_absent() {
    let dir = tempfile::tempdir().unwrap();
    for case in ["rigid-walls-sine", "elastic-wall"] {
        let folder = dir.path().join(case);
        said(dir.path(), &["run", case, "--no-verdict", "--out", case], 0);
        forget_records(&folder);
        let own = page(&folder);
        change(&folder, "summary.json", |summary| {
            walls(summary).for_each(|wall| drop(wall.as_object_mut().unwrap().remove("force_largest").unwrap()));
        });
        let older = page(&folder);
        assert_eq!((&older["facts"], &older["notes"]), (&own["facts"], &own["notes"]), "{case}");
        let largest = |page: &Value| page["summary"]["statistics"]["walls"][0]["force_largest"]["mean_n"].clone();
        assert!(largest(&own).is_number() && largest(&own) == largest(&older));
        change(&folder, "summary.json", |summary| {
            for wall in walls(summary) {
                wall["force"].as_object_mut().unwrap().remove("largest");
                wall["episode_peak_force_n"]["max"] = Value::Null;
            }
        });
        let oldest = page(&folder);
        let told = oldest["notes"].to_string();
        assert!(told.contains("summary.json has no largest force of") && told.contains("older version"), "{told}");
        assert!(!oldest["facts"].to_string().contains("largest force"));
    }
}

#[test]
fn histories_of_wear_of_an_older_version_keep_their_bands_and_absent_columns_are_named() {
    let dir = tempfile::tempdir().unwrap();
    let short = ["--set", "time.end=0.2", "--set", "time.statistics_from=0.1", "--years", "1", "--histories", "2"];
    said(dir.path(), &[&["wear", "tube-in-cross-flow", "--out", "w"], &short[..]].concat(), 0);
    let folder = dir.path().join("w");
    forget_records(&folder);
    assert_eq!(page(&folder)["wear"]["seeds"], 2);
    change(&folder, "request.json", |manifest| {
        assert_eq!((&manifest["histories"], &manifest["request"]["histories"]), (&2.into(), &2.into()));
        manifest.as_object_mut().unwrap().remove("histories");
    });
    let table = fs::read_to_string(folder.join("years.csv")).unwrap();
    let header: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    let kept: Vec<usize> = (0..header.len()).filter(|&i| !header[i].starts_with("depth_deepest")).collect();
    let row = |line: &str| kept.iter().map(|&i| line.split(',').nth(i).unwrap()).collect::<Vec<_>>().join(",");
    fs::write(folder.join("years.csv"), table.lines().map(|line| row(line) + "\n").collect::<String>()).unwrap();
    let older = page(&folder);
    assert_eq!(older["wear"]["seeds"], 2, "without it the page has no bands");
    let told = older["notes"].to_string();
    assert!(told.contains("years.csv has no depth_deepest_m: an older version wrote it"), "{told}");
}

#[test]
fn means_of_an_older_version_are_shown_under_the_names_of_today() {
    let dir = tempfile::tempdir().unwrap();
    let short = ["--set", "time.end=0.2", "--set", "time.statistics_from=0.1", "--set", "system.modes=6"];
    let own = ["run", "tube-round-supports", "--seeds", "2", "--no-verdict", "--out", "w"];
    said(dir.path(), &[&own[..], &short[..]].concat(), 0);
    let folder = dir.path().join("w");
    forget_records(&folder);
    let own = page(&folder);
    let names = |page: &Value| {
        let columns = page["draws"]["table"]["columns"].as_array().unwrap().iter();
        columns.map(|column| column["name"].as_str().unwrap().to_owned()).collect::<Vec<_>>()
    };
    assert!(["force_mean_N", "force_mean_y_N", "force_rms_N"].iter().all(|name| names(&own).contains(&(*name).into())));
    change(&folder, "summary.json", |summary| {
        walls(summary).for_each(|wall| {
            let wall = wall.as_object_mut().unwrap();
            let largest = wall.remove("force_largest").unwrap();
            wall.insert("largest_force".to_owned(), largest);
        });
        for one in summary["realisations"]["estimates"].as_array_mut().unwrap() {
            let older = match one["measure"].as_str().unwrap() {
                "force_mean" => "mean_force",
                "force_rms" => "rms_force",
                "force_largest" => "largest_force",
                other => other,
            };
            one["measure"] = older.into();
        }
    });
    let table = fs::read_to_string(folder.join("realisations.csv")).unwrap();
    let older = table
        .replace("force_mean_N", "mean_force_N")
        .replace("force_mean_y_N", "mean_force_along_y_N")
        .replace("force_mean_z_N", "mean_force_along_z_N")
        .replace("force_rms_N", "RMS_force_N")
        .replace("force_largest_N", "largest_force_N");
    assert_ne!(older, table);
    fs::write(folder.join("realisations.csv"), older).unwrap();
    let older = page(&folder);
    assert_eq!(names(&older), names(&own));
    for key in ["facts", "cards", "notes"] {
        assert_eq!(older[key], own[key], "{key}");
    }
    let measures = |page: &Value| page["summary"]["realisations"]["estimates"].clone();
    assert_eq!(measures(&older), measures(&own));
}
