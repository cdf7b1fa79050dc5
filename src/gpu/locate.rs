//! Where a fault in an assembled shader lies in the files it was made of.

use std::fmt::Write;
use std::ops::Range;

use wesl::syntax::{GlobalDeclaration, Ident, ModulePath};
use wesl::{CompileResult, SourceMap as _};

use super::GpuError;
use super::assemble::Source;

/// For each declaration of an assembled text, where it was declared.
#[derive(Debug)]
pub(super) struct SourceMap {
    declarations: Vec<Declaration>,
}

#[derive(Debug)]
struct Declaration {
    /// Bytes of the assembled text.
    assembled: Range<usize>,
    /// Stem of its file.
    stem: String,
    /// Text of its file up to it, and its own.
    before: String,
    text: String,
}

impl SourceMap {
    /// Print the assembled shader, and note where each declaration is from.
    pub(super) fn print(joined: &CompileResult, files: &[Source<'_>], root: &str) -> (String, Self) {
        let mut wgsl = String::new();
        let mut declarations = Vec::new();
        for directive in &joined.syntax.global_directives {
            let _ = writeln!(wgsl, "{directive}");
        }
        for declaration in &joined.syntax.global_declarations {
            if matches!(declaration.node(), GlobalDeclaration::Void) {
                continue;
            }
            let start = wgsl.len();
            let _ = writeln!(wgsl, "{declaration}\n");
            let declared =
                name(declaration.node()).and_then(|name| joined.sourcemap.as_ref()?.get_decl(&name.name()));
            let stem = declared.map_or_else(|| root.to_owned(), |(path, _)| stem(path));
            let source = files.iter().find(|file| file.0 == stem).map_or("", |file| file.1);
            let span = declaration.span().range();
            declarations.push(Declaration {
                assembled: start..wgsl.len(),
                stem,
                before: source.get(..span.start).unwrap_or_default().to_owned(),
                text: source.get(span).unwrap_or_default().to_owned(),
            });
        }
        (wgsl, Self { declarations })
    }

    /// A fault at `place` of the assembled text; without a place, at the first declaration.
    pub(super) fn error(&self, wgsl: &str, place: Option<Range<usize>>, message: String) -> GpuError {
        let start = place.map_or(0, |place| place.start);
        let Some(declaration) = self.declarations.iter().find(|one| start < one.assembled.end) else {
            return GpuError::Shader { file: "shaders".into(), line: 1, column: 1, message };
        };
        let inside = declaration.find(wgsl, start.max(declaration.assembled.start));
        let before = format!("{}{}", declaration.before, &declaration.text[..inside]);
        located(&declaration.stem, &before, message)
    }
}

impl Declaration {
    /// The place in `text` of byte `start` of the assembled text: that of the same line, whatever its blanks, or
    /// the beginning where the printer broke the lines otherwise.
    fn find(&self, wgsl: &str, start: usize) -> usize {
        let line_start = wgsl[..start].rfind('\n').map_or(0, |end| end + 1);
        let wanted = squeezed(wgsl[line_start..].lines().next().unwrap_or_default());
        let mut offset = 0;
        for line in self.text.split_inclusive('\n') {
            let code = line.split("//").next().unwrap_or_default();
            if !wanted.is_empty() && squeezed(code) == wanted {
                return offset + (code.len() - code.trim_start().len());
            }
            offset += line.len();
        }
        0
    }
}

/// What a declaration declares.
fn name(declaration: &GlobalDeclaration) -> Option<Ident> {
    match declaration {
        GlobalDeclaration::Declaration(variable) => Some(variable.ident.clone()),
        GlobalDeclaration::TypeAlias(alias) => Some(alias.ident.clone()),
        GlobalDeclaration::Struct(record) => Some(record.ident.clone()),
        GlobalDeclaration::Function(function) => Some(function.ident.clone()),
        GlobalDeclaration::Void | GlobalDeclaration::ConstAssert(_) => None,
    }
}

/// The line without blanks.
fn squeezed(line: &str) -> String {
    line.chars().filter(|char| !char.is_whitespace()).collect()
}

/// A fault that wesl found, with the file and line that it names.
pub(super) fn shader_error(error: wesl::Error, files: &[Source<'_>], root: &str) -> GpuError {
    let diagnostic = wesl::Diagnostic::from(error);
    let detail = &diagnostic.detail;
    let stem = detail.module_path.as_ref().map_or_else(|| root.to_owned(), stem);
    let source = files.iter().find(|file| file.0 == stem).map_or("", |file| file.1);
    let start = detail.span.as_ref().map_or(0, |span| span.range().start);
    let message = match &*diagnostic.error {
        wesl::Error::ParseError(error) => error.error.to_string(),
        error => error.to_string(),
    };
    located(&stem, source.get(..start).unwrap_or(source), message)
}

/// A fault in the file `stem`, just behind the text `before`.
fn located(stem: &str, before: &str, message: String) -> GpuError {
    let column = before.chars().rev().take_while(|&char| char != '\n').count() + 1;
    GpuError::Shader {
        file: format!("shaders/{stem}.wgsl"),
        line: before.matches('\n').count() as u32 + 1,
        column: column as u32,
        message,
    }
}

fn stem(path: &ModulePath) -> String {
    path.components.join("/")
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::assemble::assemble;
    use super::super::testing::PLAIN;
    use super::*;

    const MAIN: &str = "import package::area::{square};\n\n@compute @workgroup_size(1)\nfn main() {\n    let x = square(2.0);\n}\n";

    /// File, line and column of the fault in `area`.
    fn fault(area: &str) -> (String, u32, u32, String) {
        match assemble(&[("main", MAIN), ("area", area)], "main", "main", &PLAIN).unwrap_err() {
            GpuError::Shader { file, line, column, message } => (file, line, column, message),
            other => panic!("{other}"),
        }
    }

    #[test]
    fn a_syntax_error_is_reported_in_its_file() {
        let (file, line, column, message) =
            fault("// Area.\nfn square(x: f32) -> f32 {\n    return x * ;\n}\n");
        assert_eq!((file.as_str(), line, column), ("shaders/area.wgsl", 3, 16), "{message}");
    }

    #[test]
    fn a_type_error_is_reported_on_its_line() {
        let (file, line, column, message) = fault(
            "// Area.\nfn square(x: f32) -> f32 {\n    // Multiply.\n    let y = x   * 2u; // no\n    return y;\n}\n",
        );
        assert_eq!((file.as_str(), line, column), ("shaders/area.wgsl", 4, 5), "{message}");
    }

    #[test]
    fn a_missing_import_names_the_file_and_what_it_lacks() {
        let (file, _, _, message) = fault("fn cube(x: f32) -> f32 { return x; }\n");
        assert_eq!(file, "shaders/area.wgsl");
        assert!(message.contains("square"), "{message}");
    }

    #[test]
    fn a_validation_error_is_reported_in_its_function() {
        let (file, line, _, message) =
            fault("// Area.\n\nfn square(x: f32) -> f32 {\n    if x > 0.0 { return x; }\n}\n");
        assert_eq!((file.as_str(), line), ("shaders/area.wgsl", 3), "{message}");
    }
}
