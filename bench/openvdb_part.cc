// SPDX-License-Identifier: LGPL-2.1-or-later
// A trimmed part by level sets, with OpenVDB: solid, offset, struts, CSG, one isosurface, STL.
//
//     openvdb_part PART.stl STRUTS.bin VOXEL SKIN OUT.stl
//
// STRUTS.bin holds eight float64 a strut: both ends (x, y, z), its radius, its joints' radius; mm.
// Prints one line of JSON: seconds of each step, triangles, peak memory in MB.

#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/LevelSetFilter.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <sys/resource.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

using openvdb::FloatGrid;
using openvdb::Vec3d;
using openvdb::Vec3s;

namespace {

constexpr float kHalfWidth = 3.0f;  // of the narrow band, in voxels

class Steps {
 public:
  void done(const char* name) {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    char text[80];
    std::snprintf(text, sizeof text, "%s\"%s\": %.3f", json_.empty() ? "" : ", ", name, seconds);
    json_ += text;
    last_ = now;
  }
  const std::string& json() const { return json_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
  std::string json_;
};

std::vector<char> bytes_of(const char* path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) throw std::runtime_error(std::string("cannot read ") + path);
  std::vector<char> bytes(static_cast<size_t>(file.tellg()));
  file.seekg(0);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return bytes;
}

FloatGrid::Ptr solid_of(const char* path, const openvdb::math::Transform& grid) {
  const std::vector<char> bytes = bytes_of(path);
  uint32_t count = 0;
  if (bytes.size() >= 84) std::memcpy(&count, &bytes[80], 4);
  if (bytes.size() < 84 + size_t(50) * count) throw std::runtime_error("no binary STL");
  std::vector<Vec3s> points(size_t(3) * count);
  std::vector<openvdb::Vec3I> triangles(count);
  for (size_t k = 0; k < count; ++k) {
    std::memcpy(&points[3 * k], &bytes[84 + 50 * k + 12], 36);
    const auto first = static_cast<uint32_t>(3 * k);
    triangles[k] = {first, first + 1, first + 2};
  }
  return openvdb::tools::meshToLevelSet<FloatGrid>(grid, points, triangles, kHalfWidth);
}

struct Strut {
  Vec3d start, end;
  double radius, joint;

  double distance(const Vec3d& point) const {
    const Vec3d axis = end - start, from = point - start;
    const double square = axis.lengthSqr();
    const double share = square > 0 ? std::clamp(from.dot(axis) / square, 0.0, 1.0) : 0.0;
    const double balls = std::min(from.length(), (point - end).length()) - joint;
    return std::min((from - share * axis).length() - radius, balls);
  }
};

// The union of struts, each sampled in the voxels about it; joined pairwise by other threads.
class Lattice {
 public:
  Lattice(const std::vector<Strut>& struts, const openvdb::math::Transform& grid)
      : struts_(struts), transform_(grid), voxel_(grid.voxelSize()[0]), field_(empty()) {}
  Lattice(Lattice& other, tbb::split)
      : struts_(other.struts_), transform_(other.transform_), voxel_(other.voxel_), field_(empty()) {}

  void operator()(const tbb::blocked_range<size_t>& range) {
    auto values = field_->getAccessor();
    const auto band = static_cast<float>(kHalfWidth * voxel_);
    for (size_t k = range.begin(); k != range.end(); ++k) {
      const Strut& strut = struts_[k];
      const double reach = std::max(strut.radius, strut.joint) + band;
      openvdb::Coord low, high;
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = int(std::floor((std::min(strut.start[axis], strut.end[axis]) - reach) / voxel_));
        high[axis] = int(std::ceil((std::max(strut.start[axis], strut.end[axis]) + reach) / voxel_));
      }
      for (auto at = openvdb::CoordBBox(low, high).begin(); at; ++at) {
        const auto distance = static_cast<float>(strut.distance((*at).asVec3d() * voxel_));
        if (distance >= band || distance >= values.getValue(*at)) continue;
        if (distance > -band) {
          values.setValueOn(*at, distance);
        } else {
          values.setValueOff(*at, -band);
        }
      }
    }
  }

  void join(Lattice& other) { openvdb::tools::csgUnion(*field_, *other.field_); }
  FloatGrid::Ptr field() const { return field_; }

 private:
  FloatGrid::Ptr empty() const {
    auto field = FloatGrid::create(static_cast<float>(kHalfWidth * voxel_));
    field->setTransform(transform_.copy());
    field->setGridClass(openvdb::GRID_LEVEL_SET);
    return field;
  }

  const std::vector<Strut>& struts_;
  const openvdb::math::Transform& transform_;
  double voxel_;
  FloatGrid::Ptr field_;
};

std::vector<Strut> struts_of(const char* path) {
  const std::vector<char> bytes = bytes_of(path);
  std::vector<Strut> struts(bytes.size() / 64);
  for (size_t k = 0; k < struts.size(); ++k) {
    double row[8];
    std::memcpy(row, &bytes[64 * k], 64);
    struts[k] = {{row[0], row[1], row[2]}, {row[3], row[4], row[5]}, row[6], row[7]};
  }
  return struts;
}

uint32_t write_stl(const FloatGrid& field, const char* path, Steps& steps) {
  std::vector<Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(field, points, triangles, quads, 0.0, 0.0);
  steps.done("isosurface");
  const auto count = static_cast<uint32_t>(triangles.size() + 2 * quads.size());
  std::ofstream file(path, std::ios::binary);
  const std::string header(80, ' ');
  file.write(header.data(), 80);
  file.write(reinterpret_cast<const char*>(&count), 4);
  std::vector<char> block;
  const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
    Vec3s rows[4] = {{}, points[a], points[b], points[c]};
    rows[0] = (rows[2] - rows[1]).cross(rows[3] - rows[1]);
    rows[0].normalize();
    const size_t at = block.size();
    block.resize(at + 50, 0);
    std::memcpy(&block[at], rows, 48);
    if (block.size() > (1u << 22)) {
      file.write(block.data(), static_cast<std::streamsize>(block.size()));
      block.clear();
    }
  };
  // OpenVDB's faces are clockwise seen from outside.
  for (const auto& t : triangles) add(t[2], t[1], t[0]);
  for (const auto& q : quads) {
    add(q[2], q[1], q[0]);
    add(q[3], q[2], q[0]);
  }
  file.write(block.data(), static_cast<std::streamsize>(block.size()));
  if (!file.flush()) throw std::runtime_error(std::string("cannot write ") + path);
  steps.done("write");
  return count;
}

}  // namespace

int main(int count, char** given) {
  if (count != 6) {
    std::fprintf(stderr, "openvdb_part PART.stl STRUTS.bin VOXEL SKIN OUT.stl\n");
    return 2;
  }
  try {
    Steps steps;
    openvdb::initialize();
    const double voxel = std::atof(given[3]);
    const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
    const FloatGrid::Ptr part = solid_of(given[1], *transform);
    steps.done("solid");
    const FloatGrid::Ptr cavity = part->deepCopy();
    openvdb::tools::LevelSetFilter<FloatGrid>(*cavity).offset(std::atof(given[4]));
    steps.done("offset");
    const std::vector<Strut> struts = struts_of(given[2]);
    Lattice lattice(struts, *transform);
    tbb::parallel_reduce(tbb::blocked_range<size_t>(0, struts.size(), 512), lattice);
    steps.done("struts");
    openvdb::tools::csgIntersection(*lattice.field(), *cavity->deepCopy());
    openvdb::tools::csgDifference(*part, *cavity);
    openvdb::tools::csgUnion(*part, *lattice.field());
    steps.done("CSG");
    const uint32_t triangles = write_stl(*part, given[5], steps);
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    std::printf("{\"steps\": {%s}, \"triangles\": %u, \"peak_mb\": %.1f}\n", steps.json().c_str(),
                triangles, used.ru_maxrss / 1024.0);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "openvdb_part: %s\n", error.what());
    return 1;
  }
}
