#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "state/world.hpp"

namespace courant::test {

/// An empty folder that goes with the object.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "courant_test_XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

inline std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream out;
  out << in.rdbuf();
  return out.str();
}

/// Three particles, ids 30, 10, 20, the last one outside the box; a quad and a triangle.
inline void fill_small_world(World& world) {
  Particles& p = world.particles;
  p.fields.resize(3);
  p.active = p.moving = 3;
  for (Index i = 0; i < 3; ++i) {
    p.id[i] = i == 0 ? 30 : 10 * i;
    p.x.set(i, {0.25 * i, 0.5, 0});
    p.v.set(i, {1.0 * i, -2.0, 0});
    p.m[i] = 0.025;
    p.rho[i] = 1000 + i;
    p.p[i] = 100.0 * i;
    p.h[i] = 0.006;
    p.part[i] = i % 2;
    p.state[i] = i == 2 ? particle_outside : particle_active;
  }
  world.nodes.fields.resize(5);
  for (Index i = 0; i < 5; ++i) {
    world.nodes.id[i] = 100 + i;
    world.nodes.x.set(i, {1.0 * (i == 1 || i == 2), 1.0 * (i >= 2), i == 4 ? 2.0 : 0.0});
  }
  Segments& s = world.segments;
  s.fields.resize(2);
  for (Index i = 0; i < 2; ++i) {
    s.id[i] = 200 + i;
    s.part[i] = 1;
    s.thickness[i] = 0.001;
    s.keep_contact_force().set(i, {0, -5.0 - i, 0});
    s.node0[i] = 0, s.node1[i] = 1, s.node2[i] = 2, s.node3[i] = i == 0 ? 3 : 2;
  }
}

}  // namespace courant::test
