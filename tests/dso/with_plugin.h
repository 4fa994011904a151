// Shaders that call subsurface.so, on small grids, with clouds in a folder of the test's own.
#pragma once

#include "stdlib/subsurface/point_cloud.h"
#include "tests/plugins/plugged.h"
#include "tests/temp_folder.h"

#include <set>

namespace subsurface::test {

class WithPlugin : public ::testing::Test, protected slvm::test::Plugged {
protected:
  WithPlugin() : Plugged({slvm::test::plugin_folder("dso")}) {}

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  /// As a string of the shading language.
  std::string quoted(const std::string& name) const { return '"' + path(name) + '"'; }
  void save(const std::string& name, const PointCloud& cloud) {
    ASSERT_TRUE(write_point_cloud(path(name), cloud));
  }
  PointCloud cloud(const std::string& name) {
    auto read = read_point_cloud(path(name));
    EXPECT_TRUE(read) << (read ? "" : read.error());
    return read ? *read : PointCloud();
  }
  /// Runs a surface on a grid of nu by nv points in the square 0..1, z = 1; Ci of each.
  std::vector<Color> run(const std::string& statements, int nu, int nv = 1) {
    auto surface = bind("surface s() { " + statements + " }");
    slvm::Grid grid = slvm::test::square(nu, nv);
    slvm::ShadingContext context(machine, services);
    if (surface) context.shade({.surface = surface.get()}, grid);
    return slvm::test::colours_of<Color>(grid);
  }

  /// What messages there are beyond those that were taken before.
  std::vector<std::string> new_messages() {
    std::vector<std::string> out;
    for (std::string& m : messages())
      if (told_.insert(m).second) out.push_back(std::move(m));
    return out;
  }

  std::set<std::string> told_;
  anemone::test::TempFolder folder_;
};

} // namespace subsurface::test
