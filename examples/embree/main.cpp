// Embree on the rays that `snellius bench --rays MESH.obj --dump DIR` writes: rates, and hits compared one by one.
// docs/performance.md says how to build and run it.
//
// usage: embree MESH.obj DIR [ROUNDS]

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <pmmintrin.h>
#include <xmmintrin.h>

struct Ray { float origin[3], tmin, direction[3], tmax; };
struct Hit { float t; uint32_t face; };
constexpr uint32_t NONE = ~0u;

[[noreturn]] static void fail(const std::string& message) {
  std::fprintf(stderr, "%s\n", message.c_str());
  std::exit(2);
}

/// The records of a file of rays or hits.
template <class T> static std::vector<T> read_records(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  uint32_t count = 0;
  if (!file.read(reinterpret_cast<char*>(&count), 4)) fail("cannot read " + path);
  std::vector<T> records(count);
  if (!file.read(reinterpret_cast<char*>(records.data()), sizeof(T) * count)) fail(path + " is too short");
  return records;
}

/// A mesh of triangles: `v` and `f` statements alone.
static RTCGeometry read_mesh(RTCDevice device, const std::string& path) {
  std::ifstream file(path);
  if (!file) fail("cannot read " + path);
  std::vector<float> points;
  std::vector<unsigned> corners;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      float point[3];
      words >> point[0] >> point[1] >> point[2];
      points.insert(points.end(), point, point + 3);
    } else if (kind == "f") {
      int found = 0;
      for (std::string corner; words >> corner; ++found) corners.push_back(std::stoul(corner) - 1);
      if (found != 3) fail(path + ": only triangles");
    }
  }
  RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* to = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, points.size() / 3);
  std::memcpy(to, points.data(), points.size() * 4);
  to = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, corners.size() / 3);
  std::memcpy(to, corners.data(), corners.size() * 4);
  rtcCommitGeometry(mesh);
  return mesh;
}

static void set(RTCRay& to, const Ray& ray) {
  to.org_x = ray.origin[0], to.org_y = ray.origin[1], to.org_z = ray.origin[2], to.tnear = ray.tmin;
  to.dir_x = ray.direction[0], to.dir_y = ray.direction[1], to.dir_z = ray.direction[2], to.tfar = ray.tmax;
  to.time = 0, to.mask = ~0u, to.id = 0, to.flags = 0;
}

static void single(RTCScene scene, const std::vector<Ray>& rays, bool any, std::vector<Hit>& hits) {
#if RTC_VERSION_MAJOR < 4
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
#endif
  for (size_t i = 0; i < rays.size(); ++i) {
    RTCRayHit query;
    set(query.ray, rays[i]);
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR < 4
    any ? rtcOccluded1(scene, &context, &query.ray) : rtcIntersect1(scene, &context, &query);
#else
    any ? rtcOccluded1(scene, &query.ray) : rtcIntersect1(scene, &query);
#endif
    bool hit = any ? query.ray.tfar < 0 : query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    hits[i] = {hit && !any ? query.ray.tfar : 0, hit ? any ? 0 : query.hit.primID : NONE};
  }
}

/// Packets of 8 neighbours, which are said to be coherent.
static void packets(RTCScene scene, const std::vector<Ray>& rays, bool any, std::vector<Hit>& hits) {
#if RTC_VERSION_MAJOR < 4
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
#else
  RTCIntersectArguments intersect;
  rtcInitIntersectArguments(&intersect);
  intersect.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  RTCOccludedArguments occlude;
  rtcInitOccludedArguments(&occlude);
  occlude.flags = RTC_RAY_QUERY_FLAG_COHERENT;
#endif
  for (size_t first = 0; first < rays.size(); first += 8) {
    alignas(32) int valid[8];
    RTCRayHit8 query;
    size_t count = std::min<size_t>(8, rays.size() - first);
    for (size_t k = 0; k < 8; ++k) {
      const Ray& ray = rays[first + std::min(k, count - 1)];
      valid[k] = k < count ? -1 : 0;
      RTCRay8& to = query.ray;
      to.org_x[k] = ray.origin[0], to.org_y[k] = ray.origin[1], to.org_z[k] = ray.origin[2];
      to.dir_x[k] = ray.direction[0], to.dir_y[k] = ray.direction[1], to.dir_z[k] = ray.direction[2];
      to.tnear[k] = ray.tmin, to.tfar[k] = ray.tmax, to.time[k] = 0;
      to.mask[k] = ~0u, to.id[k] = 0, to.flags[k] = 0;
      query.hit.geomID[k] = query.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    }
#if RTC_VERSION_MAJOR < 4
    any ? rtcOccluded8(valid, scene, &context, &query.ray) : rtcIntersect8(valid, scene, &context, &query);
#else
    any ? rtcOccluded8(valid, scene, &query.ray, &occlude) : rtcIntersect8(valid, scene, &query, &intersect);
#endif
    for (size_t k = 0; k < count; ++k) {
      bool hit = any ? query.ray.tfar[k] < 0 : query.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
      hits[first + k] = {hit && !any ? query.ray.tfar[k] : 0, hit ? any ? 0 : query.hit.primID[k] : NONE};
    }
  }
}

static double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

int main(int argc, char** argv) {
  if (argc < 3) fail("usage: embree MESH.obj DIR [ROUNDS]");
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  int rounds = argc > 3 ? std::max(1, std::atoi(argv[3])) : 11;
  RTCDevice device = rtcNewDevice(nullptr);
  RTCGeometry mesh = read_mesh(device, argv[1]);
  RTCScene scene = rtcNewScene(device);
  rtcAttachGeometry(scene, mesh);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  double started = seconds();
  rtcCommitScene(scene);
  std::printf("Embree %s, medium, robust, built in %.0f ms\n", RTC_VERSION_STRING, (seconds() - started) * 1e3);
  std::printf("| rays | mode | Mrays/s | hits | hit in one engine alone | greatest relative difference of t |\n"
              "|---|---|--:|--:|--:|--:|\n");
  std::string stem = std::string(argv[2]) + "/" + std::filesystem::path(argv[1]).stem().string() + ".";
  for (char set : std::string("PRDS")) {
    auto rays = read_records<Ray>(stem + set + ".rays");
    auto theirs = read_records<Hit>(stem + set + ".hits");
    if (rays.size() != theirs.size()) fail(stem + set + ": as many rays as hits are needed");
    for (bool coherent : {false, true}) {
      std::vector<Hit> hits(rays.size());
      std::vector<double> times;
      for (int round = 0; round <= rounds; ++round) {
        double begun = seconds();
        (coherent ? packets : single)(scene, rays, set == 'S', hits);
        if (round > 0) times.push_back(seconds() - begun);
      }
      std::sort(times.begin(), times.end());
      size_t found = 0, alone = 0;
      double worst = 0;
      for (size_t i = 0; i < hits.size(); ++i) {
        bool hit = hits[i].face != NONE, other = theirs[i].face != NONE;
        found += hit;
        alone += hit != other;
        if (hit && other && set != 'S') worst = std::max<double>(worst, std::abs(hits[i].t - theirs[i].t) / hits[i].t);
      }
      std::printf("| %c | %s | %.2f | %zu | %zu | %.1e |\n", set, coherent ? "packets of 8" : "single",
                  rays.size() / times[times.size() / 2] / 1e6, found, alone, worst);
    }
  }
}
