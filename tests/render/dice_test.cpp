// Dicing: variables of a grid, orientation rules, primitive variables.
#include "render/prims/dice.h"

#include "render/prims/patches.h"
#include "render/prims/quadrics.h"
#include "render/state/transforms.h"
#include "slvm/support/string_pool.h"

#include <gtest/gtest.h>

namespace render {
namespace {

using slvm::Global;

struct Diced {
  slvm::StringPool strings;
  slvm::Grid grid{2, 2};

  Diced(Primitive p, Orientation orientation, const Matrix4& m, UvRect rect = {}) {
    Options options;
    options.projection = ProjectionKind::kPerspective;
    Camera camera(options);
    auto attributes = std::make_shared<Attributes>();
    attributes->orientation = orientation;
    attributes->color = {0.1f, 0.2f, 0.3f};
    auto state = std::make_shared<PrimitiveState>();
    state->attributes = attributes;
    state->object_to_camera = m;
    state->camera_to_object = inverse_or_identity(m);
    state->mirrored = slvm::determinant3(m) < 0;
    p.state = state;
    GridTask task;
    task.rect = rect;
    task.nu = 5;
    task.nv = 4;
    dice({&p, 1}, task, 3, {&camera, &strings, 0.5f, 0}, {}, grid);
  }
  Vec3 get(Global g, size_t k) const {
    const slvm::Planes& p = grid.variable(g);
    return {p.get(0, k), p.get(1, k), p.get(2, k)};
  }
  float number(Global g, size_t k) const { return grid.variable(g).get(0, k); }
};

Primitive sphere() {
  return {nullptr, *make_sphere(1, -1, 1, 360), {}};
}

TEST(Dice, lattice_and_steps) {
  Diced d(sphere(), Orientation::kOutside, translation({0, 0, 5}), {0.25f, 0.5f, 0, 0.75f});
  EXPECT_EQ(d.grid.nu(), 5);
  EXPECT_EQ(d.grid.nv(), 4);
  EXPECT_FLOAT_EQ(d.number(Global::kdu, 0), 0.25f / 4);
  EXPECT_FLOAT_EQ(d.number(Global::kdv, 0), 0.25f);
  EXPECT_FLOAT_EQ(d.number(Global::ku, 4), 0.5f);
  EXPECT_FLOAT_EQ(d.number(Global::kv, 19), 0.75f);
  EXPECT_FLOAT_EQ(d.number(Global::ks, 7), d.number(Global::ku, 7));
  EXPECT_FLOAT_EQ(d.number(Global::ktime, 0), 0.5f);
  EXPECT_EQ(d.get(Global::kCs, 3), Color(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(d.get(Global::kI, 6), d.get(Global::kP, 6));
  EXPECT_EQ(d.grid.id, 3u);
}

/// Where N points: 1 away from the sphere's centre, -1 towards it; and whether the VM's Du(P) ^ Dv(P), after
/// the flip, agrees.
int outward(const Diced& d, Vec3 centre) {
  int sign = 0;
  for (size_t k = 5; k < 15; ++k) { // the poles have no tangents
    Vec3 out = d.get(Global::kP, k) - centre;
    float n = glm::dot(d.get(Global::kN, k), out);
    float computed = glm::dot(glm::cross(d.get(Global::kdPdu, k), d.get(Global::kdPdv, k)), out);
    if (d.grid.flip_normals) computed = -computed;
    EXPECT_GT(n * computed, 0);
    sign = n > 0 ? 1 : -1;
  }
  return sign;
}

TEST(Dice, orientation_and_handedness) {
  Matrix4 plain = translation({0, 0, 5}), mirrored = scaling({-1, 1, 1}) * translation({0, 0, 5});
  Vec3 c(0, 0, 5);
  EXPECT_EQ(outward(Diced(sphere(), Orientation::kOutside, plain), c), 1);
  EXPECT_EQ(outward(Diced(sphere(), Orientation::kInside, plain), c), -1);
  EXPECT_EQ(outward(Diced(sphere(), Orientation::kOutside, mirrored), c), 1);
  EXPECT_EQ(outward(Diced(sphere(), Orientation::kInside, mirrored), c), -1);
  EXPECT_EQ(outward(Diced(sphere(), Orientation::kLeftHanded, plain), c), 1);
  EXPECT_EQ(outward(Diced(sphere(), Orientation::kRightHanded, plain), c), -1);
  EXPECT_EQ(outward(Diced(sphere(), Orientation::kLeftHanded, mirrored), c), -1);
  EXPECT_EQ(outward(Diced(sphere(), Orientation::kRightHanded, mirrored), c), 1);
}

TEST(Dice, patches_of_a_mesh_share_the_parameter_square) {
  Primitive p{nullptr, make_bilinear({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)}), {}};
  p.uv = {0.5f, 0.75f, 0, 0.5f};
  Diced d(p, Orientation::kOutside, translation({0, 0, 5}));
  EXPECT_FLOAT_EQ(d.number(Global::ku, 0), 0.5f);
  EXPECT_FLOAT_EQ(d.number(Global::ku, 4), 0.75f);
  EXPECT_FLOAT_EQ(d.number(Global::kv, 19), 0.5f);
  EXPECT_FLOAT_EQ(d.number(Global::ks, 4), 0.75f);
  EXPECT_FLOAT_EQ(d.number(Global::kdu, 0), 0.25f / 4);
  // One patch is a quarter of the square wide: dPdu du is still the side of a micropolygon.
  EXPECT_EQ(d.get(Global::kdPdu, 7), Vec3(4, 0, 0));
  EXPECT_EQ(d.get(Global::kdPdv, 7), Vec3(0, 2, 0));
}

TEST(Dice, parameters_that_a_piece_brings_along_decide_texture_coordinates) {
  Primitive p{nullptr, make_bilinear({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)}), {}};
  p.vars.push_back({"u", slvm::Type::kFloat, 0, Interpolation::kBilinear, {0.25f, 0.5f, 0.25f, 0.5f}, {}});
  p.vars.push_back({"v", slvm::Type::kFloat, 0, Interpolation::kBilinear, {0, 0, 0.5f, 0.5f}, {}});
  Diced d(p, Orientation::kOutside, translation({0, 0, 5}));
  EXPECT_FLOAT_EQ(d.number(Global::ku, 4), 0.5f);
  EXPECT_FLOAT_EQ(d.number(Global::ks, 4), 0.5f);
  EXPECT_FLOAT_EQ(d.number(Global::kt, 19), 0.5f);
}

TEST(Dice, normals_go_by_the_inverse_transpose) {
  // A slope squashed in x: the normal leans more to x.
  Primitive p{nullptr, make_bilinear({Vec3(0, 0, 0), Vec3(1, 0, 1), Vec3(0, 1, 0), Vec3(1, 1, 1)}), {}};
  Diced d(p, Orientation::kOutside, scaling({0.5f, 1, 1}) * translation({0, 0, 5}));
  Vec3 n = glm::normalize(d.get(Global::kN, 0));
  EXPECT_NEAR(n.x / n.z, -2, 1e-5f);
}

TEST(Dice, primitive_variables_replace_and_add) {
  Primitive p = sphere();
  p.vars.push_back(
      {"Cs", slvm::Type::kColor, 0, Interpolation::kBilinear, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, {}});
  p.vars.push_back({"st", slvm::Type::kFloat, 2, Interpolation::kBilinear, {5, 0, 6, 0, 5, 1, 6, 1}, {}});
  p.vars.push_back({"axis", slvm::Type::kVector, 0, Interpolation::kConstant, {0, 0, 1}, {}});
  p.vars.push_back({"label", slvm::Type::kString, 0, Interpolation::kConstant, {}, {"hello"}});
  p.vars.push_back({"pair", slvm::Type::kFloat, 2, Interpolation::kBilinear, {0, 0, 1, 1, 2, 2, 3, 3}, {}});
  Diced d(p, Orientation::kOutside, rotation(90, {1, 0, 0}) * translation({0, 0, 5}));
  EXPECT_NEAR(d.get(Global::kCs, 4).x, 1, 1e-6f);
  EXPECT_NEAR(d.get(Global::kCs, 17).x, 0.5f, 1e-6f);
  EXPECT_NEAR(d.number(Global::ks, 2), 5.5f, 1e-6f);
  EXPECT_NEAR(d.number(Global::kt, 19), 1, 1e-6f);
  const slvm::Planes* axis = d.grid.primvar("axis");
  ASSERT_TRUE(axis);
  EXPECT_NEAR(axis->get(1, 0), -1, 1e-6f); // z turned by 90 degrees about x
  ASSERT_TRUE(d.grid.primvar("label"));
  const slvm::Planes* pair = d.grid.primvar("pair");
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->elements, 2u);
  EXPECT_FLOAT_EQ(pair->get(1, 19), 3);
}

TEST(Dice, geometry_is_renewed_after_displacement) {
  Options options;
  Camera camera(options);
  Primitive p{nullptr, make_bilinear({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)}), {}};
  Diced d(p, Orientation::kOutside, translation({0, 0, 5}));
  float* z = d.grid.varying(Global::kP) + 2 * d.grid.pitch();
  const slvm::Planes& u = d.grid.variable(Global::ku);
  for (size_t k = 0; k < d.grid.points(); ++k)
    z[k] += 3 * u.get(0, k);
  renew_geometry(camera, d.grid);
  for (size_t k = 0; k < d.grid.points(); ++k) {
    Vec3 dPdu = d.get(Global::kdPdu, k), Ng = d.get(Global::kNg, k);
    EXPECT_NEAR(dPdu.z, 3, 1e-4f);
    EXPECT_NEAR(Ng.x / Ng.z, -3, 1e-3f);
  }
}

} // namespace
} // namespace render
