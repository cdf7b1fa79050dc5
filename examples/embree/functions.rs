//! The functions of Embree 3 that are called, loaded as the program runs: names, numbers and records of its headers
//! (rtcore_*.h of 3.13).

use std::ffi::{c_char, c_int, c_void};
use std::mem::ManuallyDrop;

use bytemuck::Zeroable;
use libloading::Library;

/// Any of Embree's objects.
pub(crate) type Handle = *mut c_void;

pub(crate) const GEOMETRY_TYPE_TRIANGLE: c_int = 0;
pub(crate) const BUFFER_TYPE_INDEX: c_int = 0;
pub(crate) const BUFFER_TYPE_VERTEX: c_int = 1;
pub(crate) const FORMAT_UINT3: c_int = 0x5003;
pub(crate) const FORMAT_FLOAT3: c_int = 0x9003;
pub(crate) const SCENE_FLAG_ROBUST: c_int = 4;
pub(crate) const BUILD_QUALITY_MEDIUM: c_int = 1;
pub(crate) const DEVICE_PROPERTY_VERSION: c_int = 0;
pub(crate) const CONTEXT_FLAG_COHERENT: c_int = 1;
pub(crate) const INVALID_GEOMETRY_ID: u32 = u32::MAX;

/// RTCIntersectContext.
#[repr(C)]
pub(crate) struct Context {
    pub(crate) flags: c_int,
    pub(crate) filter: *const c_void,
    pub(crate) instance: [u32; 1],
}

/// RTCRay, and RTCRay8 as arrays of eight.
#[derive(Clone, Copy, Zeroable)]
#[repr(C, align(16))]
pub(crate) struct Ray<F, U> {
    pub(crate) origin: [F; 3],
    pub(crate) tnear: F,
    pub(crate) direction: [F; 3],
    pub(crate) time: F,
    /// Where a hit is; of a ray that is occluded -∞.
    pub(crate) tfar: F,
    pub(crate) mask: U,
    pub(crate) id: U,
    pub(crate) flags: U,
}

/// RTCHit, and RTCHit8 as arrays of eight.
#[derive(Clone, Copy, Zeroable)]
#[repr(C, align(16))]
pub(crate) struct Hit<F, U> {
    pub(crate) normal: [F; 3],
    pub(crate) uv: [F; 2],
    pub(crate) primitive: U,
    pub(crate) geometry: U,
    pub(crate) instance: [U; 1],
}

/// RTCRayHit.
#[derive(Clone, Copy, Zeroable)]
#[repr(C)]
pub(crate) struct One {
    pub(crate) ray: Ray<f32, u32>,
    pub(crate) hit: Hit<f32, u32>,
}

/// RTCRayHit8.
#[derive(Clone, Copy, Zeroable)]
#[repr(C, align(32))]
pub(crate) struct Eight {
    pub(crate) ray: Ray<[f32; 8], [u32; 8]>,
    pub(crate) hit: Hit<[f32; 8], [u32; 8]>,
}

/// Which rays of eight are there: -1, or 0.
#[repr(C, align(32))]
pub(crate) struct Valid(pub(crate) [c_int; 8]);

macro_rules! functions {
    ($($name:ident: fn($($argument:ty),*) $(-> $result:ty)?;)*) => {
        /// Embree's functions by their own names.
        #[allow(non_snake_case)]
        pub(crate) struct Functions {
            $(pub(crate) $name: unsafe extern "C" fn($($argument),*) $(-> $result)?,)*
        }

        impl Functions {
            /// # Errors
            /// If there is no such library, or it lacks one of them.
            ///
            /// # Safety
            /// The library is Embree 3: it runs code as it is loaded, and its functions are as they are here.
            pub(crate) unsafe fn load(library: &str) -> Result<Self, libloading::Error> {
                unsafe {
                    // Never unloaded: threads of its own may go on for a while.
                    let library = ManuallyDrop::new(Library::new(library)?);
                    Ok(Self { $($name: *library.get(concat!(stringify!($name), "\0").as_bytes())?,)* })
                }
            }
        }
    };
}

functions! {
    rtcNewDevice: fn(*const c_char) -> Handle;
    rtcReleaseDevice: fn(Handle);
    rtcGetDeviceError: fn(Handle) -> c_int;
    rtcGetDeviceProperty: fn(Handle, c_int) -> isize;
    rtcNewGeometry: fn(Handle, c_int) -> Handle;
    rtcSetNewGeometryBuffer: fn(Handle, c_int, u32, c_int, usize, usize) -> *mut c_void;
    rtcCommitGeometry: fn(Handle);
    rtcReleaseGeometry: fn(Handle);
    rtcNewScene: fn(Handle) -> Handle;
    rtcReleaseScene: fn(Handle);
    rtcAttachGeometry: fn(Handle, Handle) -> u32;
    rtcSetSceneFlags: fn(Handle, c_int);
    rtcSetSceneBuildQuality: fn(Handle, c_int);
    rtcCommitScene: fn(Handle);
    rtcIntersect1: fn(Handle, *mut Context, *mut One);
    rtcOccluded1: fn(Handle, *mut Context, *mut Ray<f32, u32>);
    rtcIntersect8: fn(*const Valid, Handle, *mut Context, *mut Eight);
    rtcOccluded8: fn(*const Valid, Handle, *mut Context, *mut Ray<[f32; 8], [u32; 8]>);
}
