//! `snellius SCENE`: for now, how to render instead.

use std::path::Path;

use super::CliError;

/// What to say to someone who opens a scene in a build without a viewer.
pub(super) fn no_viewer(scene: &Path) -> CliError {
    if !scene.exists() {
        return CliError::usage(format!("{}: neither a scene file nor a command", scene.display()))
            .hint("snellius --help lists the commands");
    }
    let picture = Path::new(scene.file_stem().unwrap_or(scene.as_os_str())).with_extension("png");
    CliError::usage("this build has no viewer").hint(format!(
        "render the scene to a picture instead: snellius render {} -o {}",
        scene.display(),
        picture.display()
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_is_told_how_to_be_rendered() {
        let message = no_viewer(Path::new("Cargo.toml")).render(false);
        assert!(message.contains("snellius render Cargo.toml -o Cargo.png"), "{message}");
    }

    #[test]
    fn a_mistyped_command_is_not_taken_for_a_scene() {
        let message = no_viewer(Path::new("rendr")).render(false);
        assert!(message.contains("rendr: neither a scene file nor a command"), "{message}");
    }
}
