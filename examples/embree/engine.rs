//! Embree as the other engine: a mesh in it, and rays through that.

use std::error::Error;
use std::ffi::c_int;
use std::ptr;
use std::time::{Duration, Instant};

use bytemuck::Zeroable;
use rayon::ThreadPool;
use rayon::prelude::*;
use snellius::bench::rays::{Mode, Query, RayAnswer, RayRecord};

use crate::functions::{
    BUFFER_TYPE_INDEX, BUFFER_TYPE_VERTEX, BUILD_QUALITY_MEDIUM, CONTEXT_FLAG_COHERENT, Context,
    DEVICE_PROPERTY_VERSION, Eight, FORMAT_FLOAT3, FORMAT_UINT3, Functions, GEOMETRY_TYPE_TRIANGLE, Handle,
    INVALID_GEOMETRY_ID, One, SCENE_FLAG_ROBUST, Valid,
};

/// Rays that a thread takes at a time, as of Snellius.
const CHUNK: usize = 4096;

/// Embree 3 with a device, which has as many threads as the processor.
pub(crate) struct Embree {
    functions: Functions,
    device: Handle,
}

impl Embree {
    /// Load the library.
    ///
    /// # Errors
    /// If there is none, or it is not Embree 3.
    pub(crate) fn load(library: &str) -> Result<Self, Box<dyn Error>> {
        // SAFETY: Embree does nothing harmful as it is loaded; of another library its functions are missing.
        let functions = unsafe { Functions::load(library) }.map_err(|error| {
            format!("{error}; Embree 3 is needed (Debian: libembree3-3), or --library PATH")
        })?;
        // SAFETY: a null pointer asks for the defaults.
        let device = unsafe { (functions.rtcNewDevice)(ptr::null()) };
        let embree = Self { functions, device };
        embree.check()?;
        match embree.version() {
            version @ 30000..=39999 => Ok(version),
            version => Err(format!("{library} is of version {version}, not Embree 3")),
        }?;
        Ok(embree)
    }

    /// 10000 · major + 100 · minor + patch.
    pub(crate) fn version(&self) -> isize {
        // SAFETY: the device is there as long as this is.
        unsafe { (self.functions.rtcGetDeviceProperty)(self.device, DEVICE_PROPERTY_VERSION) }
    }

    /// What Embree last found wrong.
    fn check(&self) -> Result<(), Box<dyn Error>> {
        // SAFETY: without a device it tells why there is none.
        match unsafe { (self.functions.rtcGetDeviceError)(self.device) } {
            0 if !self.device.is_null() => Ok(()),
            code => Err(format!("Embree fails with RTCError {code}").into()),
        }
    }
}

impl Drop for Embree {
    fn drop(&mut self) {
        if !self.device.is_null() {
            // SAFETY: nothing that belongs to the device outlives this.
            unsafe { (self.functions.rtcReleaseDevice)(self.device) }
        }
    }
}

/// A mesh in Embree, robust, built in medium quality.
pub(crate) struct Scene<'a> {
    embree: &'a Embree,
    scene: Handle,
}

// SAFETY: a scene that is committed is only read, and may be traced by any thread.
unsafe impl Sync for Scene<'_> {}

impl<'a> Scene<'a> {
    /// Build it; tells how long that took.
    ///
    /// # Errors
    /// What Embree says.
    pub(crate) fn build(
        embree: &'a Embree,
        points: &[[f32; 3]],
        triangles: &[[u32; 3]],
    ) -> Result<(Self, Duration), Box<dyn Error>> {
        let Embree { functions: f, device } = embree;
        // SAFETY: Embree makes room for as many records as it is asked for, or returns null; both have three words.
        let fill = |geometry, buffer, format, words: &[u32]| unsafe {
            let to = (f.rtcSetNewGeometryBuffer)(geometry, buffer, 0, format, 12, words.len() / 3);
            if !to.is_null() {
                ptr::copy_nonoverlapping(words.as_ptr(), to.cast(), words.len());
            }
        };
        // SAFETY: handles of this device; the scene keeps the geometry.
        let scene = unsafe {
            let geometry = (f.rtcNewGeometry)(*device, GEOMETRY_TYPE_TRIANGLE);
            fill(geometry, BUFFER_TYPE_VERTEX, FORMAT_FLOAT3, bytemuck::cast_slice(points));
            fill(geometry, BUFFER_TYPE_INDEX, FORMAT_UINT3, bytemuck::cast_slice(triangles));
            (f.rtcCommitGeometry)(geometry);
            let scene = (f.rtcNewScene)(*device);
            (f.rtcAttachGeometry)(scene, geometry);
            (f.rtcReleaseGeometry)(geometry);
            (f.rtcSetSceneFlags)(scene, SCENE_FLAG_ROBUST);
            (f.rtcSetSceneBuildQuality)(scene, BUILD_QUALITY_MEDIUM);
            Self { embree, scene }
        };
        let started = Instant::now();
        // SAFETY: a scene of this device.
        unsafe { (f.rtcCommitScene)(scene.scene) };
        let took = started.elapsed();
        embree.check()?;
        Ok((scene, took))
    }

    /// Trace rays with a pool's threads: one by one, or as packets of eight neighbours, which are said to be coherent. Tells
    /// how long that took.
    pub(crate) fn trace(
        &self,
        rays: &[RayRecord],
        query: Query,
        mode: Mode,
        pool: &ThreadPool,
        found: &mut [RayAnswer],
    ) -> Duration {
        let chunks = || {
            let pairs = rays.par_chunks(CHUNK).zip(found.par_chunks_mut(CHUNK));
            pairs.with_max_len(1).for_each(|(rays, found)| match mode {
                Mode::Single => self.one_by_one(rays, query, found),
                Mode::Coherent => self.in_packets(rays, query, found),
            });
        };
        let started = Instant::now();
        pool.install(chunks);
        started.elapsed()
    }

    fn one_by_one(&self, rays: &[RayRecord], query: Query, found: &mut [RayAnswer]) {
        let f = &self.embree.functions;
        let mut context = context(0);
        let mut one = One::zeroed();
        one.ray.mask = u32::MAX;
        one.hit.instance = [INVALID_GEOMETRY_ID];
        for (ray, found) in rays.iter().zip(found) {
            one.ray.origin = ray.origin;
            one.ray.tnear = ray.tmin;
            one.ray.direction = ray.direction;
            one.ray.tfar = ray.tmax;
            one.hit.geometry = INVALID_GEOMETRY_ID;
            // SAFETY: records as Embree's, of a scene that is committed.
            unsafe {
                match query {
                    Query::Nearest => (f.rtcIntersect1)(self.scene, &raw mut context, &raw mut one),
                    Query::Any => (f.rtcOccluded1)(self.scene, &raw mut context, &raw mut one.ray),
                }
            }
            *found = answer(query, one.ray.tfar, one.hit.geometry, one.hit.primitive);
        }
    }

    fn in_packets(&self, rays: &[RayRecord], query: Query, found: &mut [RayAnswer]) {
        let f = &self.embree.functions;
        let mut context = context(CONTEXT_FLAG_COHERENT);
        let mut eight = Eight::zeroed();
        eight.ray.mask = [u32::MAX; 8];
        eight.hit.instance = [[INVALID_GEOMETRY_ID; 8]];
        for (rays, found) in rays.chunks(8).zip(found.chunks_mut(8)) {
            let valid = Valid(std::array::from_fn(|lane| if lane < rays.len() { -1 } else { 0 }));
            for (lane, ray) in rays.iter().enumerate() {
                for axis in 0..3 {
                    eight.ray.origin[axis][lane] = ray.origin[axis];
                    eight.ray.direction[axis][lane] = ray.direction[axis];
                }
                eight.ray.tnear[lane] = ray.tmin;
                eight.ray.tfar[lane] = ray.tmax;
            }
            eight.hit.geometry = [INVALID_GEOMETRY_ID; 8];
            let (of, to) = (&raw const valid, &raw mut context);
            // SAFETY: as one by one.
            unsafe {
                match query {
                    Query::Nearest => (f.rtcIntersect8)(of, self.scene, to, &raw mut eight),
                    Query::Any => (f.rtcOccluded8)(of, self.scene, to, &raw mut eight.ray),
                }
            }
            for (lane, found) in found.iter_mut().enumerate() {
                let hit = (eight.hit.geometry[lane], eight.hit.primitive[lane]);
                *found = answer(query, eight.ray.tfar[lane], hit.0, hit.1);
            }
        }
    }
}

impl Drop for Scene<'_> {
    fn drop(&mut self) {
        // SAFETY: its device is still there.
        unsafe { (self.embree.functions.rtcReleaseScene)(self.scene) }
    }
}

fn context(flags: c_int) -> Context {
    Context { flags, filter: ptr::null(), instance: [INVALID_GEOMETRY_ID] }
}

fn answer(query: Query, tfar: f32, geometry: u32, primitive: u32) -> RayAnswer {
    match query {
        Query::Nearest if geometry != INVALID_GEOMETRY_ID => RayAnswer { t: tfar, face: primitive },
        Query::Any if tfar < 0.0 => RayAnswer { t: 0.0, face: 0 },
        Query::Nearest | Query::Any => RayAnswer::MISS,
    }
}
