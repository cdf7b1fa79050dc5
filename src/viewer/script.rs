//! Events from a file: what a hand does to the window, and what is expected of it.
//!
//! One event a line; `#` begins a comment. Lengths are pixels of the picture.
//!
//! ```text
//! orbit DX DY STEPS       drag with the left button from the middle of the picture, in so many steps; each waits for its picture
//! pan DX DY STEPS         the same with the right button
//! wheel LINES STEPS       turn the wheel over the middle of the picture; positive comes nearer
//! click X Y               press and release the left button
//! double-click X Y
//! key [ctrl+][shift+]KEY  press and release a key: A … Z, 0 … 9, Home, F12, ArrowLeft, …
//! resize W H              of the picture
//! minimise, restore
//! drop PATH               a file onto the window
//! copy FROM TO            copy a file over another, as an editor would save it
//! view NAME [NAME]        what is shown; two stand beside each other
//! backend cpu|gpu
//! theme light|dark
//! lose                    lose the device
//! screenshot PATH         write the window to a PNG file
//! turntable N             write so many pictures from round the pivot
//! wait rest               until the picture is complete
//! wait MS                 so many milliseconds
//! expect toast TEXT       a message that holds the text is shown within a minute
//! expect size W H         of the picture, complete
//! expect backend cpu|gpu
//! expect tree TEXT        a line of the outline of the clicked pixel's rays holds the text
//! expect frame MS         no frame of the window has taken longer by now
//! expect answer MS        by now, half of the inputs that moved the camera have changed pixels within this time
//! expect idle PERCENT MS  so long, with no event, the program takes less than this part of one core (Linux)
//! quit
//! ```

use std::path::PathBuf;

use egui::{Key, Modifiers};

use super::look::ViewKind;

/// An event of a script.
#[derive(Debug, Clone, PartialEq)]
pub enum Event {
    /// Drag by so many pixels in so many steps; not with the left button, but the right one, if `pans`.
    Drag {
        /// Pixels to the right and down.
        by: [f32; 2],
        /// Steps that wait for their picture.
        steps: u32,
        /// With the right button.
        pans: bool,
    },
    /// Turn the wheel by so many lines in so many steps.
    Wheel {
        /// Lines, positive away from the hand.
        lines: f32,
        /// Steps that wait for their picture.
        steps: u32,
    },
    /// Press and release the left button, so many times.
    Click {
        /// Pixel of the picture.
        at: [f32; 2],
        /// 1 or 2.
        times: u32,
    },
    /// Press and release a key.
    Key(Modifiers, Key),
    /// Make the picture so large.
    Resize([u32; 2]),
    /// Minimise the window, or restore it.
    Minimise(bool),
    /// Drop a file.
    Drop(PathBuf),
    /// Copy a file over another.
    Copy(PathBuf, PathBuf),
    /// Show this, and that beside it.
    View(ViewKind, Option<ViewKind>),
    /// Trace on the CPU, or not.
    Backend {
        /// The CPU.
        is_cpu: bool,
    },
    /// Dark or light.
    Theme(egui::Theme),
    /// Lose the device.
    Lose,
    /// Write the window to a file.
    Screenshot(PathBuf),
    /// Write so many pictures from round the pivot.
    Turntable(u32),
    /// Until the picture is complete.
    Rest,
    /// So many milliseconds.
    Sleep(u64),
    /// What is to be.
    Expect(Expectation),
    /// Close the window.
    Quit,
}

/// What is to be.
#[derive(Debug, Clone, PartialEq)]
pub enum Expectation {
    /// A message that holds this text.
    Toast(String),
    /// The complete picture's size.
    Size([u32; 2]),
    /// Who traces.
    Backend {
        /// The CPU.
        is_cpu: bool,
    },
    /// A line of the clicked pixel's rays that holds this text.
    Tree(String),
    /// The longest frame of the window, in milliseconds.
    Frame(f64),
    /// The median time from an input that moves the camera to the first changed pixels, in milliseconds.
    Answer(f64),
    /// Less than this part of one core for so long.
    Idle {
        /// Percent of one core.
        percent: f64,
        /// For so long.
        milliseconds: u64,
    },
}

/// A line that is no event.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {message}")]
pub struct ScriptError {
    /// From 1.
    pub line: usize,
    /// What is wrong.
    pub message: String,
}

/// The events of a script with their lines, from 1.
///
/// # Errors
/// The first line that is no event.
pub fn parse(text: &str) -> Result<Vec<(usize, Event)>, ScriptError> {
    let lines = (1..).zip(text.lines().map(|line| line.split('#').next().unwrap_or_default().trim()));
    lines
        .filter(|(_, line)| !line.is_empty())
        .map(|(number, line)| match event(line) {
            Ok(event) => Ok((number, event)),
            Err(message) => Err(ScriptError { line: number, message }),
        })
        .collect()
}

fn event(line: &str) -> Result<Event, String> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let rest = |count: usize| line.splitn(count + 1, char::is_whitespace).last().unwrap_or_default().trim();
    Ok(match words.as_slice() {
        ["orbit", x, y, steps] => {
            Event::Drag { by: [number(x)?, number(y)?], steps: count(steps)?, pans: false }
        }
        ["pan", x, y, steps] => {
            Event::Drag { by: [number(x)?, number(y)?], steps: count(steps)?, pans: true }
        }
        ["wheel", lines, steps] => Event::Wheel { lines: number(lines)?, steps: count(steps)? },
        ["click", x, y] => Event::Click { at: [number(x)?, number(y)?], times: 1 },
        ["double-click", x, y] => Event::Click { at: [number(x)?, number(y)?], times: 2 },
        ["key", keys] => key(keys)?,
        ["resize", width, height] => Event::Resize([count(width)?, count(height)?]),
        ["minimise"] => Event::Minimise(true),
        ["restore"] => Event::Minimise(false),
        ["drop", ..] => Event::Drop(rest(1).into()),
        ["copy", from, to] => Event::Copy(from.into(), to.into()),
        ["view", first] => Event::View(view(first)?, None),
        ["view", first, second] => Event::View(view(first)?, Some(view(second)?)),
        ["backend", name] => Event::Backend { is_cpu: is_cpu(name)? },
        ["theme", "dark"] => Event::Theme(egui::Theme::Dark),
        ["theme", "light"] => Event::Theme(egui::Theme::Light),
        ["lose"] => Event::Lose,
        ["screenshot", ..] => Event::Screenshot(rest(1).into()),
        ["turntable", pictures] => Event::Turntable(count(pictures)?),
        ["wait", "rest"] => Event::Rest,
        ["wait", time] => {
            Event::Sleep(time.parse().map_err(|_| format!("{time} is no number of milliseconds"))?)
        }
        ["expect", "toast", ..] => Event::Expect(Expectation::Toast(rest(2).to_owned())),
        ["expect", "size", width, height] => {
            Event::Expect(Expectation::Size([count(width)?, count(height)?]))
        }
        ["expect", "backend", name] => Event::Expect(Expectation::Backend { is_cpu: is_cpu(name)? }),
        ["expect", "tree", ..] => Event::Expect(Expectation::Tree(rest(2).to_owned())),
        ["expect", "frame", time] => Event::Expect(Expectation::Frame(milliseconds(time)?)),
        ["expect", "answer", time] => Event::Expect(Expectation::Answer(milliseconds(time)?)),
        ["expect", "idle", percent, time] => Event::Expect(Expectation::Idle {
            percent: percent.parse().map_err(|_| format!("{percent} is no number"))?,
            milliseconds: time.parse().map_err(|_| format!("{time} is no number of milliseconds"))?,
        }),
        ["quit"] => Event::Quit,
        _ => return Err(format!("`{line}` is no event")),
    })
}

fn number(word: &str) -> Result<f32, String> {
    word.parse().ok().filter(|number: &f32| number.is_finite()).ok_or_else(|| format!("{word} is no number"))
}

fn milliseconds(word: &str) -> Result<f64, String> {
    word.parse()
        .ok()
        .filter(|time: &f64| *time > 0.0)
        .ok_or_else(|| format!("{word} is no number of milliseconds"))
}

fn count(word: &str) -> Result<u32, String> {
    word.parse().ok().filter(|&count| count > 0).ok_or_else(|| format!("{word} is no count above 0"))
}

fn is_cpu(word: &str) -> Result<bool, String> {
    match word {
        "cpu" => Ok(true),
        "gpu" => Ok(false),
        _ => Err(format!("{word} is no backend: cpu or gpu")),
    }
}

fn view(word: &str) -> Result<ViewKind, String> {
    ViewKind::all().find(|kind| kind.name() == word).ok_or_else(|| {
        let names: Vec<_> = ViewKind::all().map(ViewKind::name).collect();
        format!("{word} is no view: {}", names.join(", "))
    })
}

fn key(word: &str) -> Result<Event, String> {
    let mut modifiers = Modifiers::NONE;
    let mut rest = word;
    loop {
        if let Some(after) = rest.strip_prefix("ctrl+") {
            (modifiers, rest) = (modifiers | Modifiers::CTRL | Modifiers::COMMAND, after);
        } else if let Some(after) = rest.strip_prefix("shift+") {
            (modifiers, rest) = (modifiers | Modifiers::SHIFT, after);
        } else {
            break;
        }
    }
    let key = Key::from_name(rest).ok_or_else(|| format!("{rest} is no key"))?;
    Ok(Event::Key(modifiers, key))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn events_stand_one_a_line_and_comments_are_left_out() {
        let text = "# a hand\n\norbit 100 -20 5  # to the right\nwait rest\nkey ctrl+shift+S\n\
                    screenshot a picture.png\nexpect toast no models\nview beauty rays\n";
        let events = parse(text).unwrap();
        let expected = [
            (3, Event::Drag { by: [100.0, -20.0], steps: 5, pans: false }),
            (4, Event::Rest),
            (5, Event::Key(Modifiers::CTRL | Modifiers::COMMAND | Modifiers::SHIFT, Key::S)),
            (6, Event::Screenshot("a picture.png".into())),
            (7, Event::Expect(Expectation::Toast("no models".into()))),
            (8, Event::View(ViewKind::Beauty, Some(ViewKind::Aov(crate::film::AovKind::Rays)))),
        ];
        assert_eq!(events, expected);
    }

    #[test]
    fn what_is_no_event_is_told_with_its_line() {
        for (text, line, message) in [
            ("orbit 1 2", 1, "`orbit 1 2` is no event"),
            ("\nresize 0 4", 2, "0 is no count above 0"),
            ("key Nope", 1, "Nope is no key"),
            ("view beuty", 1, "beuty is no view: beauty, depth"),
            ("orbit x 1 1", 1, "x is no number"),
        ] {
            let error = parse(text).unwrap_err();
            assert!(error.line == line && error.message.starts_with(message), "{error}");
        }
    }
}
