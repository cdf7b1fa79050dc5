//! From shader files and a variant to one checked module: imports, `@if`, constants, naga's validation.

use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use wesl::{CompileOptions, Feature, ManglerKind, ModulePath, VirtualResolver, Wesl};

use super::locate::{SourceMap, shader_error};
use super::{GpuError, Variant};
use crate::layout::Precision;

/// A shader file: its stem, which is the name of its module, and its text.
pub type Source<'a> = (&'a str, &'a str);

/// Name of the generated module of constants.
const CONSTANTS: &str = "constants";

/// One entry point with all that it calls.
#[derive(Debug)]
pub struct Shader {
    /// The assembled text.
    pub wgsl: String,
    /// The same, parsed.
    pub module: naga::Module,
    /// What validation found out about it.
    pub info: ModuleInfo,
}

/// Assemble the entry point `entry` of the file `root`.
///
/// Files import each other with `import package::stem::{name};` and the constants with
/// `import package::constants::{NAME};`. Names are kept, so they must be unique over all files.
///
/// # Errors
/// [`GpuError::Shader`] names the file and line of a fault.
pub fn assemble(
    sources: &[Source<'_>],
    root: &str,
    entry: &str,
    variant: &Variant,
) -> Result<Shader, GpuError> {
    let constants = variant.constants_module();
    let files: Vec<Source<'_>> = sources.iter().copied().chain([(CONSTANTS, constants.as_str())]).collect();
    let (wgsl, map) = join(&files, root, entry, variant)?;
    let module = naga::front::wgsl::parse_str(&wgsl).map_err(|error| {
        let place = error.labels().next().and_then(|(span, _)| span.to_range());
        map.error(&wgsl, place, describe_parse_error(&error))
    })?;
    let mut validator = Validator::new(ValidationFlags::all(), capabilities(variant));
    let info = validator.validate(&module).map_err(|error| {
        // The function, the statement and the expression are named: the shortest is the nearest.
        let place = error.spans().filter_map(|(span, _)| span.to_range()).min_by_key(std::ops::Range::len);
        map.error(&wgsl, place, describe_chain(error.as_inner()))
    })?;
    Ok(Shader { wgsl, module, info })
}

/// Resolve imports and `@if`, and keep what `entry` needs.
fn join(
    files: &[Source<'_>],
    root: &str,
    entry: &str,
    variant: &Variant,
) -> Result<(String, SourceMap), GpuError> {
    let mut resolver = VirtualResolver::new();
    for &(stem, text) in files {
        resolver.add_module(module_path(stem), text.into());
    }
    let mut compiler = Wesl::new_barebones().set_custom_resolver(resolver);
    compiler
        .set_options(CompileOptions {
            // naga validates, and wesl knows no f64.
            validate: false,
            keep: Some(vec![entry.to_owned()]),
            ..CompileOptions::default()
        })
        .use_sourcemap(true)
        .set_mangler(ManglerKind::None);
    for (name, on) in variant.features() {
        compiler.set_feature(&name, if on { Feature::Enable } else { Feature::Disable });
    }
    let joined = compiler.compile(&module_path(root)).map_err(|error| shader_error(error, files, root))?;
    Ok(SourceMap::print(&joined, files, root))
}

fn module_path(stem: &str) -> ModulePath {
    ModulePath::new(wesl::syntax::PathOrigin::Absolute, vec![stem.to_owned()])
}

/// What the shaders may use beyond the core of WGSL.
fn capabilities(variant: &Variant) -> Capabilities {
    match variant.precision {
        Precision::F32 => Capabilities::empty(),
        Precision::F64 => Capabilities::FLOAT64,
    }
}

/// naga's message with its labels: the message alone often says less.
fn describe_parse_error(error: &naga::front::wgsl::ParseError) -> String {
    let labels: Vec<_> = error.labels().map(|(_, label)| label).filter(|label| !label.is_empty()).collect();
    match labels.as_slice() {
        [] => error.message().to_owned(),
        labels => format!("{} ({})", error.message(), labels.join("; ")),
    }
}

/// An error with its causes, outermost first.
fn describe_chain(error: &dyn std::error::Error) -> String {
    let causes = std::iter::successors(Some(error), |error| error.source());
    causes.map(ToString::to_string).collect::<Vec<_>>().join(": ")
}
