//! Words and numbers on the command line to the library's types.

use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

use clap::ValueEnum;
use clap::builder::PossibleValue;

use crate::film::{AovKind, BitDepth, Metric, Tone};
use crate::layout::{Backend, Effect, EffectChoice, EffectSet, Float, Intersector, Precision};

/// Offer these values of a library type under these names, each with one line of help.
macro_rules! words {
    ($($type:ty { $($value:expr => $name:literal, $help:literal;)+ })+) => {$(
        impl ValueEnum for $type {
            fn value_variants<'a>() -> &'a [Self] {
                &[$($value),+]
            }

            fn to_possible_value(&self) -> Option<PossibleValue> {
                [$(($value, $name, $help)),+]
                    .into_iter()
                    .find(|(value, ..)| value == self)
                    .map(|(_, name, help)| PossibleValue::new(name).help(help))
            }
        }
    )+};
}

words! {
    Backend {
        Self::Gpu => "gpu", "a Vulkan adapter";
        Self::Cpu => "cpu", "all cores of the processor";
    }
    Precision {
        Self::F32 => "f32", "32 bits: fast, the same bits on every strict device";
        Self::F64 => "f64", "64 bits: slower, to judge the other by";
    }
    Float {
        Self::Strict => "strict", "every operation as written: the CPU's bits";
        Self::Fast => "fast", "the driver may contract and reorder";
    }
    Intersector {
        Self::Watertight => "watertight", "no ray passes between two triangles (Woop et al. 2013)";
        Self::MollerTrumbore => "moller-trumbore", "the textbook's; leaks at edges";
    }
    Tone {
        Self::None => "none", "clamp to what a display can show";
        Self::Reinhard => "reinhard", "the brightest pixel becomes white (Reinhard et al. 2002)";
        Self::Aces => "aces", "a filmic curve (Narkowicz 2015)";
    }
    BitDepth {
        Self::Eight => "8", "256 levels";
        Self::Sixteen => "16", "65536 levels";
    }
    ErrorMetric {
        Self::Rmse => "rmse", "root mean square over pixels and channels";
        Self::Max => "max", "the greatest error of a channel";
        Self::Flip => "flip", "the mean error that a person sees (Andersson et al. 2020)";
    }
    ProgressStyle {
        Self::Auto => "auto", "a bar on a terminal, else nothing";
        Self::Plain => "plain", "a line now and then";
        Self::None => "none", "nothing";
    }
}

/// The name of a value as the command line spells it.
pub(super) fn name_of(value: impl ValueEnum) -> String {
    value.to_possible_value().map_or_else(String::new, |possible| possible.get_name().to_owned())
}

/// Which error a budget limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ErrorMetric {
    Rmse,
    Max,
    Flip,
}

impl From<ErrorMetric> for Metric {
    fn from(metric: ErrorMetric) -> Self {
        match metric {
            ErrorMetric::Rmse => Self::Rmse,
            ErrorMetric::Max => Self::Max,
            ErrorMetric::Flip => Self::Flip,
        }
    }
}

/// How progress is shown on standard error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ProgressStyle {
    Auto,
    Plain,
    None,
}

/// `WxH` in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Size(pub(super) [u32; 2]);

/// Greatest width and height, as in scene files.
const MAX_SIDE: u32 = 16384;

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let sides = text.split_once(['x', '×']).and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
        match sides {
            Some(sides) if sides.iter().all(|side| (1..=MAX_SIDE).contains(side)) => Ok(Self(sides)),
            Some(_) => Err(format!("width and height are from 1 to {MAX_SIDE}")),
            None => Err("expected WIDTHxHEIGHT in pixels, as in 1280x720".to_owned()),
        }
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}", self.0[0], self.0[1])
    }
}

/// `X,Y,Z` in scene units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Point(pub(super) [f64; 3]);

impl FromStr for Point {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Option<Vec<f64>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
        match numbers.as_deref() {
            Some(&[x, y, z]) if [x, y, z].iter().all(|x| x.abs() <= MAX_COORDINATE) => Ok(Self([x, y, z])),
            _ => Err("expected X,Y,Z within ±2^60, as in 0,1.5,4".to_owned()),
        }
    }
}

/// 2^60: as far as scenes reach.
const MAX_COORDINATE: f64 = (1_u64 << 60) as f64;

/// `X,Y,W,H` in pixels, from the top left.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Crop(pub(super) [u32; 4]);

impl Crop {
    /// Whether the rectangle lies in a picture of this size.
    pub(super) fn fits(self, [width, height]: [u32; 2]) -> bool {
        let [x, y, w, h] = self.0;
        x.checked_add(w).is_some_and(|right| right <= width)
            && y.checked_add(h).is_some_and(|low| low <= height)
    }
}

impl fmt::Display for Crop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, w, h] = self.0;
        write!(f, "{x},{y},{w},{h}")
    }
}

impl FromStr for Crop {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Option<Vec<u32>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
        match numbers.as_deref() {
            Some(&[_, _, 0, _] | &[_, _, _, 0]) => Err("width and height are at least 1".to_owned()),
            Some(&[x, y, w, h]) => Ok(Self([x, y, w, h])),
            _ => Err("expected X,Y,WIDTH,HEIGHT in pixels from the top left, as in 0,0,64,64".to_owned()),
        }
    }
}

/// `NAME=PATH`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct AovFile {
    pub(super) kind: AovKind,
    pub(super) path: PathBuf,
}

impl FromStr for AovFile {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, path) = text.split_once('=').ok_or("expected NAME=PATH, as in depth=depth.exr")?;
        let kind = AovKind::ALL.into_iter().find(|kind| kind.name() == name).ok_or_else(|| {
            format!("no such name; there are {}", AovKind::ALL.map(AovKind::name).join(", "))
        })?;
        if path.is_empty() {
            return Err("the path is empty".to_owned());
        }
        Ok(Self { kind, path: path.into() })
    }
}

/// `METRIC=VALUE`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Threshold {
    pub(super) metric: Metric,
    pub(super) limit: f64,
}

impl FromStr for Threshold {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, limit) = text.split_once('=').ok_or("expected METRIC=VALUE, as in rmse=0.01")?;
        let metric =
            Metric::ALL.into_iter().find(|metric| metric.name() == name.replace('-', "_")).ok_or_else(
                || format!("a limit is set on one of {}", Metric::ALL.map(Metric::name).join(", ")),
            )?;
        match limit.parse() {
            Ok(limit) if limit >= 0.0 => Ok(Self { metric, limit }),
            _ => Err("the value is a number ≥ 0".to_owned()),
        }
    }
}

/// `auto`, `all`, `none`, or names of effects with commas.
pub(super) fn effect_choice(text: &str) -> Result<EffectChoice, String> {
    match text {
        "auto" => Ok(EffectChoice::Auto),
        "all" => Ok(EffectChoice::All),
        "none" => Ok(EffectChoice::Only(EffectSet::NONE)),
        names => names.split(',').map(effect).collect::<Result<_, _>>().map(EffectChoice::Only),
    }
}

fn effect(name: &str) -> Result<Effect, String> {
    Effect::ALL.into_iter().find(|effect| effect.name() == name.trim()).ok_or_else(|| {
        let names = Effect::ALL.map(Effect::name).join(", ");
        format!("expected auto, all, none, or names with commas; there is no effect {name:?}, but {names}")
    })
}

/// A whole number in this range.
pub(super) fn whole_in(text: &str, least: u32, most: u32) -> Result<u32, String> {
    match text.parse() {
        Ok(number) if (least..=most).contains(&number) => Ok(number),
        _ => Err(format!("expected a whole number from {least} to {most}")),
    }
}

/// A finite number in this range.
pub(super) fn number_in(text: &str, least: f64, most: f64) -> Result<f64, String> {
    match text.parse() {
        Ok(number) if (least..=most).contains(&number) => Ok(number),
        _ => Err(format!("expected a number from {least} to {most}")),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn sizes_are_width_by_height() {
        assert_eq!("640x480".parse(), Ok(Size([640, 480])));
        for wrong in ["640", "640x", "0x480", "640x99999", "-1x2", "6.5x2", "1e3x2"] {
            assert!(wrong.parse::<Size>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn crops_lie_in_the_picture() {
        let crop: Crop = "600,400,40,80".parse().unwrap();
        assert!(crop.fits([640, 480]));
        assert!(!crop.fits([639, 480]) && !crop.fits([640, 479]));
        assert!(!Crop([u32::MAX, 0, 2, 1]).fits([640, 480]));
        for wrong in ["1,2,3", "1,2,0,4", "1,2,3,4,5", "a,b,c,d"] {
            assert!(wrong.parse::<Crop>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn every_aov_can_be_named() {
        for kind in AovKind::ALL {
            let file: AovFile = format!("{}=a=b.exr", kind.name()).parse().unwrap();
            assert_eq!(file, AovFile { kind, path: "a=b.exr".into() });
        }
        assert!("colour=a.exr".parse::<AovFile>().unwrap_err().contains("depth, normal"));
    }

    #[test]
    fn thresholds_take_either_spelling() {
        let threshold = Threshold { metric: Metric::DifferingPixels, limit: 0.0 };
        assert_eq!("differing_pixels=0".parse(), Ok(threshold));
        assert_eq!("differing-pixels=0".parse(), Ok(threshold));
        for wrong in ["rmse", "rmse=", "rmse=-1", "rmse=NaN", "psnr=30"] {
            assert!(wrong.parse::<Threshold>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn effects_are_chosen_by_name() {
        assert_eq!(effect_choice("auto"), Ok(EffectChoice::Auto));
        for effect in Effect::ALL {
            assert_eq!(effect_choice(effect.name()), Ok(EffectChoice::Only(EffectSet::of(&[effect]))));
        }
        let two = EffectSet::of(&[Effect::Shadows, Effect::Specular]);
        assert_eq!(effect_choice("specular, shadows"), Ok(EffectChoice::Only(two)));
        for wrong in ["", "shadow", "auto,all", "shadows,"] {
            assert!(effect_choice(wrong).unwrap_err().contains("tinted-shadows"), "{wrong}");
        }
    }

    #[test]
    fn numbers_outside_their_range_are_refused() {
        assert_eq!(number_in("1e-4", 0.0, 1.0), Ok(1e-4));
        for wrong in ["NaN", "inf", "-0.1", "1.1", "x"] {
            assert!(number_in(wrong, 0.0, 1.0).is_err(), "{wrong}");
        }
    }

    #[test]
    fn whole_numbers_outside_their_range_are_refused() {
        assert_eq!(whole_in("64", 0, 64), Ok(64));
        for wrong in ["65", "-1", "1.5", "x", ""] {
            assert!(whole_in(wrong, 0, 64).is_err(), "{wrong}");
        }
    }

    #[test]
    fn every_word_names_its_value() {
        assert_eq!(name_of(Intersector::MollerTrumbore), "moller-trumbore");
        assert_eq!(name_of(Backend::Cpu), "cpu");
        for tone in Tone::ALL {
            assert_eq!(name_of(tone), tone.name());
        }
    }
}
