//! `snellius SCENE`: for now, how to render instead.

use std::ffi::OsString;
use std::path::Path;

use clap::CommandFactory;

use super::{Cli, CliError};

/// What to say to someone who opens a scene in a build without a viewer, or who mistypes a command.
pub(super) fn no_viewer(words: &[OsString]) -> CliError {
    let scene = Path::new(words.first().map_or("".as_ref(), OsString::as_os_str));
    if !scene.exists() {
        return CliError::usage(format!("{}: neither a command nor a file", scene.display()))
            .hint(advice(&scene.to_string_lossy()));
    }
    let picture = Path::new(scene.file_stem().unwrap_or(scene.as_os_str())).with_extension("png");
    CliError::usage("this build has no viewer").hint(format!(
        "render the scene to a picture instead: snellius render {} -o {}",
        scene.display(),
        picture.display()
    ))
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
        no_viewer(&[word.into()]).render(false)
    }

    #[test]
    fn a_scene_is_told_how_to_be_rendered() {
        assert!(message("Cargo.toml").contains("snellius render Cargo.toml -o Cargo.png"));
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
