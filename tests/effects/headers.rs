//! `check` lists for each scene exactly the effects that the scene's own header promises.

use std::path::Path;
use std::process::Command;

use super::subject::files;

/// How a line of a header begins that lists effects; the list ends with a full stop.
const PROMISE: &str = "# Effects: ";

/// The effects that a scene's header promises.
fn promised(path: &Path) -> Vec<String> {
    let text = std::fs::read_to_string(path).unwrap();
    let header = text.lines().take_while(|line| line.starts_with('#'));
    let list: Vec<_> = header.skip_while(|line| !line.starts_with(PROMISE)).collect();
    let list = list.join(" ").replace("# ", "");
    let list = list.trim_start_matches(PROMISE.trim_start_matches("# "));
    let list = list.split('.').next().unwrap();
    list.split(',').map(|name| name.trim().to_owned()).collect()
}

#[test]
fn check_lists_exactly_what_each_header_promises_and_says_why() {
    for path in files() {
        let check =
            Command::new(env!("CARGO_BIN_EXE_snellius")).arg("check").arg(&path).arg("--json").output();
        let report: serde_json::Value = serde_json::from_slice(&check.unwrap().stdout).unwrap();
        let effects = report["effects"].as_array().unwrap();
        let on = effects.iter().filter(|effect| effect["on"] == true);
        let listed: Vec<_> = on.map(|effect| effect["name"].as_str().unwrap()).collect();
        assert_eq!(listed, promised(&path), "{path:?}");
        assert!(effects.iter().all(|effect| effect["reason"].as_str().unwrap().len() > 10), "{path:?}");
    }
}
