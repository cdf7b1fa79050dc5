//! `snellius SCENE`: the viewer, or how to render in a build without one.

#[cfg(feature = "viewer")]
mod open;

use std::ffi::OsString;
use std::path::Path;

use clap::CommandFactory;

use super::console::Console;
use super::{Cli, CliError, Outcome};

#[cfg(feature = "viewer")]
pub(super) use open::{ViewArgs, run};

/// Open the scene that the words begin with; flags of `view` may follow.
#[cfg(feature = "viewer")]
pub(super) fn open_words(words: &[OsString], console: Console) -> Result<Outcome, CliError> {
    use clap::Parser;

    check_scene(words)?;
    let line = ["snellius".into(), "view".into()].into_iter().chain(words.iter().cloned());
    // clap prints usage errors, and exits with 2.
    match Cli::parse_from(line).command {
        Some(super::Command::View(args)) => run(*args, console),
        _ => Err(CliError::usage("not a scene")),
    }
}

/// Tell how to render the scene that the words begin with.
#[cfg(not(feature = "viewer"))]
pub(super) fn open_words(words: &[OsString], _: Console) -> Result<Outcome, CliError> {
    let scene = check_scene(words)?;
    let picture = Path::new(scene.file_stem().unwrap_or(scene.as_os_str())).with_extension("png");
    Err(CliError::usage("this build has no viewer").hint(format!(
        "render the scene to a picture instead: snellius render {} -o {}",
        scene.display(),
        picture.display()
    )))
}

/// The scene that someone wants to open, if it is no mistyped command.
fn check_scene(words: &[OsString]) -> Result<&Path, CliError> {
    let scene = Path::new(words.first().map_or("".as_ref(), OsString::as_os_str));
    if scene.exists() {
        return Ok(scene);
    }
    Err(CliError::usage(format!("{}: neither a command nor a file", scene.display()))
        .hint(advice(&scene.to_string_lossy())))
}

/// The command that was meant, if one is much like it.
fn advice(word: &str) -> String {
    let likeness = |name: &str| strsim::jaro_winkler(word, name);
    Cli::command()
        .get_subcommands()
        .map(|command| command.get_name().to_owned())
        .filter(|name| likeness(name) > 0.8)
        .max_by(|a, b| likeness(a).total_cmp(&likeness(b)))
        .map_or_else(
            || "snellius --help lists the commands".to_owned(),
            |name| format!("did you mean `snellius {name}`?"),
        )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(word: &str) -> String {
        check_scene(&[word.into()]).err().map_or_else(String::new, |error| error.render(false))
    }

    #[cfg(not(feature = "viewer"))]
    #[test]
    fn a_scene_is_told_how_to_be_rendered() {
        let error = open_words(&["Cargo.toml".into()], Console::new(true, false)).err();
        let message = error.map_or_else(String::new, |error| error.render(false));
        assert!(message.contains("snellius render Cargo.toml -o Cargo.png"));
    }

    #[test]
    fn a_mistyped_command_is_not_taken_for_a_scene() {
        let message = message("rendr");
        assert!(message.contains("rendr: neither a command nor a file"), "{message}");
        assert!(message.contains("did you mean `snellius render`?"), "{message}");
    }

    #[test]
    fn what_is_like_no_command_is_sent_to_the_help() {
        assert!(message("picture.toml").contains("snellius --help lists the commands"));
    }
}
