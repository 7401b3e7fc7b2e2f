#include <polyfem/core/error.hpp>
#include <polyfem/dealii/vertex_dofs.hpp>
#include <tests/polyfem/dealii/refined_triangulation.hpp>

#include <deal.II/base/function.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/vector_tools_interpolate.h>

#include <gtest/gtest.h>

using namespace polyfem;

namespace {

/// Something that is different everywhere and in each component.
double field(double x, double y, unsigned component) {
  return 1 + x + 10 * y + x * y * y + component * (100 - 3 * x);
}

class Field : public dealii::Function<2> {
 public:
  using Function::Function;
  double value(const dealii::Point<2>& x, unsigned component) const override {
    return field(x[0], x[1], component);
  }
};

VectorXd values_at_vertices(const PolygonMesh& mesh, unsigned n_components) {
  VectorXd values(n_components * mesh.vertices.cols());
  for (Index i = 0; i < values.size(); ++i) {
    const Vec2 x = mesh.vertices.col(i / n_components);
    values[i] = field(x.x(), x.y(), static_cast<unsigned>(i % n_components));
  }
  return values;
}

/// What goes over is what deal.II's own interpolation puts there, and it comes back.
void expect_interpolation(const dealii::DoFHandler<2>& dof_handler) {
  const unsigned n_components = dof_handler.get_fe_collection().n_components();
  const TriangulationMesh mesh = polygon_mesh(dof_handler.get_triangulation());
  const VectorXd values = values_at_vertices(mesh, n_components);
  dealii::Vector<double> dofs, expected(dof_handler.n_dofs());
  to_dofs(mesh, values, dof_handler, dofs);
  dealii::VectorTools::interpolate(dof_handler, Field(n_components), expected);
  ASSERT_EQ(dofs.size(), expected.size());
  expected -= dofs;
  EXPECT_LT(expected.linfty_norm(), 1e-12);
  EXPECT_EQ(from_dofs(mesh, dof_handler, dofs), values);
}

class VertexDofs : public testing::Test {
 protected:
  VertexDofs() {
    dealii::GridGenerator::hyper_L(triangulation);
    std::mt19937 random(3);
    support::refine_randomly(triangulation, 3, random);
    triangulation.refine_global();
    for (const auto& cell : triangulation.active_cell_iterators())
      if (cell->center()[0] < 0) cell->set_coarsen_flag();
    triangulation.execute_coarsening_and_refinement();
    mesh = polygon_mesh(triangulation);
    EXPECT_LT(mesh.vertices.cols(), static_cast<Index>(triangulation.n_vertices())) << "no vertex is unused";
  }

  void expect_refusal(const dealii::FiniteElement<2>& element, const char* message) {
    dof_handler.distribute_dofs(element);
    dealii::Vector<double> dofs(dof_handler.n_dofs());
    for (const bool there : {true, false}) try {
        if (there)
          to_dofs(mesh, values_at_vertices(mesh, 1), dof_handler, dofs);
        else
          from_dofs(mesh, dof_handler, dofs);
        ADD_FAILURE() << "not refused: " << message;
      } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
      }
  }

  dealii::Triangulation<2> triangulation;
  dealii::DoFHandler<2> dof_handler{triangulation};
  TriangulationMesh mesh;
};

TEST_F(VertexDofs, AreThoseOfDealIIsInterpolationHoweverNumbered) {
  for (const unsigned n_components : {1u, 2u, 3u}) {
    dof_handler.distribute_dofs(dealii::FESystem<2>(dealii::FE_Q<2>(1), n_components));
    expect_interpolation(dof_handler);
    dealii::DoFRenumbering::Cuthill_McKee(dof_handler);
    expect_interpolation(dof_handler);
    dealii::DoFRenumbering::component_wise(dof_handler);
    expect_interpolation(dof_handler);
  }
  dof_handler.distribute_dofs(dealii::FE_Q<2>(1));
  expect_interpolation(dof_handler);
  dof_handler.distribute_dofs(dealii::FESystem<2>(dealii::FESystem<2>(dealii::FE_Q<2>(1), 2), 1));
  expect_interpolation(dof_handler);
}

TEST(VertexDofsOfTriangles, AreThoseOfDealIIsInterpolation) {
  dealii::Triangulation<2> triangulation;
  dealii::GridGenerator::subdivided_hyper_cube_with_simplices(triangulation, 3);
  dealii::DoFHandler<2> dof_handler(triangulation);
  dof_handler.distribute_dofs(dealii::FE_SimplexP<2>(1));
  expect_interpolation(dof_handler);
  dof_handler.distribute_dofs(dealii::FESystem<2>(dealii::FE_SimplexP<2>(1), 2));
  expect_interpolation(dof_handler);
}

TEST_F(VertexDofs, OfElementsWithOtherUnknownsAreRefused) {
  expect_refusal(dealii::FE_Q<2>(2), "FE_Q<2>(2) does not have one unknown per vertex");
  expect_refusal(dealii::FE_DGQ<2>(1), "FE_DGQ<2>(1) does not have one unknown per vertex");
  expect_refusal(dealii::FESystem<2>(dealii::FE_Q<2>(1), 1, dealii::FE_DGQ<2>(0), 1),
                 "one unknown per vertex");
}

TEST_F(VertexDofs, OfATriangulationRefinedSinceAreRefused) {
  triangulation.begin_active()->set_refine_flag();
  triangulation.execute_coarsening_and_refinement();
  expect_refusal(dealii::FE_Q<2>(1), "make the mesh anew");
}

TEST_F(VertexDofs, InWrongNumberAreRefused) {
  dof_handler.distribute_dofs(dealii::FE_Q<2>(1));
  dealii::Vector<double> dofs(dof_handler.n_dofs() + 1);
  EXPECT_THROW(from_dofs(mesh, dof_handler, dofs), Error);
  EXPECT_THROW(to_dofs(mesh, VectorXd::Zero(2 * mesh.vertices.cols()), dof_handler, dofs), Error);
}

}  // namespace
