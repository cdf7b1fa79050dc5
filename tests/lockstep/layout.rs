//! Guard 1: the records in the buffers lie alike on both sides.

use std::mem::offset_of;

use bytemuck::Zeroable;
use naga::{ArraySize, Module, Scalar, ScalarKind, StructMember, Type, TypeInner, VectorSize};
use snellius::gpu::{SOURCES, Source, assemble};
use snellius::layout::{
    Aov, Attribute, FilmHead, Light, Material, Statistics, Texel, Tile, TreeNode, Triangle, View, WideNode,
};

use super::planted::Planted;
use super::variants;

/// A record as one language lays it out.
#[derive(Debug, PartialEq)]
struct Record {
    name: &'static str,
    size: usize,
    fields: Vec<Field>,
}

#[derive(Debug, Clone, PartialEq)]
struct Field {
    name: String,
    offset: usize,
    /// In Rust's words.
    kind: String,
}

/// A Rust record; a field that is not listed does not compile.
macro_rules! record {
    ($name:literal, $type:ident { $($field:ident),* $(,)? }) => {{
        let $type { $($field),* } = $type::zeroed();
        Record {
            name: $name,
            size: size_of::<$type>(),
            fields: vec![$(Field {
                name: stringify!($field).to_owned(),
                offset: offset_of!($type, $field),
                kind: std::any::type_name_of_val(&$field).to_owned(),
            }),*],
        }
    }};
}

/// Every record of a buffer, as Rust lays it out.
fn rust_records() -> Vec<Record> {
    let frame = Record {
        name: "Frame",
        size: size_of::<View>(),
        fields: vec![
            Field { name: "view".into(), offset: 0, kind: "View".into() },
            Field { name: "lights".into(), offset: size_of::<View>(), kind: "[Light]".into() },
        ],
    };
    let film_texel = Record {
        name: "FilmTexel",
        size: size_of::<Texel>() + size_of::<Aov>() + size_of::<Statistics>(),
        fields: vec![
            Field { name: "texel".into(), offset: 0, kind: "Texel".into() },
            Field { name: "aov".into(), offset: size_of::<Texel>(), kind: "Aov".into() },
            Field {
                name: "statistics".into(),
                offset: size_of::<Texel>() + size_of::<Aov>(),
                kind: "Statistics".into(),
            },
        ],
    };
    vec![
        record!("WideNode", WideNode { origin, scales, first_child, first_triangle, leaves, planes }),
        record!("Triangle", Triangle { v0, id, v1, reserved1, v2, reserved2 }),
        record!("Attribute", Attribute { normal, material, normal0, body, normal1, other, normal2, uvs }),
        record!(
            "Material",
            Material {
                ambient,
                ior,
                diffuse,
                shininess,
                specular,
                fresnel,
                reflection,
                texture,
                transmission,
                texture_width,
                absorption,
                texture_height,
            }
        ),
        record!("Light", Light { position, inverse_square, intensity, reserved }),
        record!("Texel", Texel { radiance, dropped, bound, rays, primitive_hash, body_hash }),
        record!("Aov", Aov { normal, depth, body, medium, reserved }),
        record!("Statistics", Statistics { sum, squares, samples, body, start, listed }),
        record!(
            "View",
            View {
                eye,
                width,
                forward,
                height,
                right,
                start_media,
                up,
                depth,
                ambient,
                cutoff,
                horizon,
                samples,
                zenith,
                lights,
                scene_lo,
                transmissive_bodies,
                scene_hi,
                environment,
                environment_width,
                environment_height,
                environment_turn,
                environment_intensity,
                crop,
                media,
                radiance_bound,
            }
        ),
        record!(
            "Tile",
            Tile {
                first_block,
                block_count,
                first_sample,
                sample_count,
                first_row,
                step_budget,
                resume,
                canary_rounds,
                canary_result,
                listed,
                round,
                threshold,
            }
        ),
        record!(
            "FilmHead",
            FilmHead { tile, done, paused, cut_short, primary, reflection, refraction, shadow, listed }
        ),
        record!(
            "TreeNode",
            TreeNode {
                origin,
                kind,
                direction,
                depth,
                weight,
                end,
                light,
                media,
                point,
                id,
                normal,
                body,
                arriving,
                media_behind,
                distance,
                front,
                children,
                seen,
                shadow_rays,
                reserved,
            }
        ),
        film_texel,
        frame,
    ]
}

/// What differs between the records of both languages.
fn differences(sources: &[Source<'_>]) -> Vec<String> {
    let variant = variants::all().into_iter().find(|variant| variant.aovs() && variant.adaptive()).unwrap();
    let module = assemble(sources, "render", "render", &variant).unwrap().module;
    rust_records().iter().flat_map(|record| record_differences(record, &module)).collect()
}

fn record_differences(record: &Record, module: &Module) -> Vec<String> {
    let name = record.name;
    let Some((_, shader)) = module.types.iter().find(|(_, kind)| kind.name.as_deref() == Some(name)) else {
        return vec![format!("{name} is not in the shaders")];
    };
    let TypeInner::Struct { members, span } = &shader.inner else {
        return vec![format!("{name} is no struct in the shaders")];
    };
    let fields: Vec<_> = members.iter().map(|member| field(member, module)).collect();
    let rust: Vec<_> =
        record.fields.iter().map(|field| Field { kind: short(&field.kind), ..field.clone() }).collect();
    let mut found: Vec<_> = (0..rust.len().max(fields.len()))
        .filter(|&index| rust.get(index) != fields.get(index))
        .map(|index| format!("{name}: {:?} in Rust, {:?} in the shaders", rust.get(index), fields.get(index)))
        .collect();
    // A frame ends with lights without end.
    if *span as usize != record.size && name != "Frame" {
        found.push(format!("{name}: {} bytes in Rust, {span} in the shaders", record.size));
    }
    found
}

fn field(member: &StructMember, module: &Module) -> Field {
    Field {
        name: member.name.clone().unwrap_or_default(),
        offset: member.offset as usize,
        kind: rust_name(&module.types[member.ty], module),
    }
}

/// A shader's type in Rust's words.
fn rust_name(kind: &Type, module: &Module) -> String {
    match &kind.inner {
        TypeInner::Scalar(scalar) | TypeInner::Atomic(scalar) => scalar_name(*scalar),
        TypeInner::Vector { size, scalar } => {
            let size = match size {
                VectorSize::Bi => 2,
                VectorSize::Tri => 3,
                VectorSize::Quad => 4,
            };
            format!("[{}; {size}]", scalar_name(*scalar))
        }
        TypeInner::Array { base, size: ArraySize::Constant(size), .. } => {
            format!("[{}; {size}]", rust_name(&module.types[*base], module))
        }
        TypeInner::Array { base, .. } => format!("[{}]", rust_name(&module.types[*base], module)),
        _ => kind.name.clone().unwrap_or_default(),
    }
}

fn scalar_name(scalar: Scalar) -> String {
    let kind = match scalar.kind {
        ScalarKind::Float => 'f',
        ScalarKind::Uint => 'u',
        ScalarKind::Sint => 'i',
        _ => '?',
    };
    format!("{kind}{}", u32::from(scalar.width) * 8)
}

/// A type's name without its path.
fn short(name: &str) -> String {
    name.rsplit("::").next().unwrap_or(name).to_owned()
}

#[test]
fn records_lie_alike_in_both_languages() {
    assert_eq!(differences(SOURCES), Vec::<String>::new());
}

#[test]
fn a_shifted_field_is_caught() {
    let planted = Planted::new(
        "records",
        "position: vec3f, inverse_square: u32",
        "inverse_square: u32, position: vec3f",
    );
    let found = differences(&planted.sources());
    assert!(found.iter().any(|line| line.contains("Light") && line.contains("position")), "{found:?}");
}

#[test]
fn a_field_of_another_type_is_caught() {
    let planted = Planted::new("records", "diffuse: vec3f, shininess: f32", "diffuse: vec3f, shininess: u32");
    assert!(assemble(&planted.sources(), "render", "render", &variants::all()[0]).is_ok());
    let found = differences(&planted.sources());
    assert!(found.iter().any(|line| line.contains("shininess")), "{found:?}");
}
