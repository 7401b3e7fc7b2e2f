// Whole pictures: they show what the frame holds, whatever it holds.

#include "sound_picture.hpp"

#include "../../support/run_scene.hpp"
#include "../output/cell_frames.hpp"

#include <ddacontact/picture/block_layer.hpp>
#include <ddacontact/picture/field_layer.hpp>
#include <ddacontact/picture/magnified.hpp>
#include <ddacontact/picture/number_text.hpp>
#include <ddacontact/picture/picture.hpp>
#include <polyfem/geometry/validity.hpp>

#include <limits>
#include <map>

namespace {

using namespace support;

TEST(Picture, AKnownStressHasItsColour) {
  const Frame frame = two_blocks();
  const pugi::xml_document document = parsed(draw({{.frame = &frame, .field = Field::sxx}}, {}));
  const ColourScale scale(Field::sxx, {-2e6, 1e6});
  const auto tension = filled(document, scale.colour(scale.band(1e6)));
  const auto compression = filled(document, scale.colour(scale.band(-2e6)));
  ASSERT_EQ(tension.size(), 1u);
  ASSERT_EQ(compression.size(), 1u);
  EXPECT_LT(tension[0][0].x(), compression[0][0].x());
  const auto shapes = outlines(document);
  ASSERT_EQ(shapes.size(), 2u);
  EXPECT_NEAR(std::abs(area(tension[0])), std::abs(area(shapes[0])), 0.5);
}

TEST(Picture, EveryBlockIsOutlinedInShapeAndPlace) {
  const Frame frame = wall(7, 5);
  const auto shapes = outlines(parsed(draw({{.frame = &frame, .field = Field::s1}}, {})));
  ASSERT_EQ(shapes.size(), 35u);
  const double scale = (shapes[6][0] - shapes[0][0]).norm() / 6;  // blocks are 1 m apart
  for (int b = 0; b < 35; ++b)
    for (int v = 0; v < 4; ++v) {
      const Vec2 x = frame.outline(b).col(v) - frame.outline(0).col(0);
      const Vec2 page = shapes[b][v] - shapes[0][0];
      EXPECT_NEAR(page.x(), scale * x.x(), 0.03);
      EXPECT_NEAR(page.y(), -scale * x.y(), 0.03);
    }
}

TEST(Picture, HigherColoursLieOnLowerOnesAndShrink) {
  const Frame frame = wall(1, 1);
  const FieldSamples samples(frame, Field::s2, 400);
  const ColourScale scale(Field::s2, samples.range());
  SvgPage page;
  samples.draw(page, {{{0, 0}, {1, 0.5}}, {0, 0}, 400}, scale);
  const pugi::xml_document document = parsed(page.finish(400, 200));
  std::map<std::string, int> band_of;
  for (int k = 0; k < scale.n_bands(); ++k) band_of[hex(scale.colour(k))] = k;
  int last = -1;
  double before = 400 * 200 * 1.0001;
  for (const pugi::xml_node& path : paths(document)) {
    const int band = band_of.at(path.attribute("fill").value());
    EXPECT_GT(band, last);
    double sum = 0;
    for (const auto& polygon : polygons(path.attribute("d").value())) sum -= area(polygon);  // y is downwards
    EXPECT_LE(sum, before);
    before = sum;
    last = band;
  }
  EXPECT_EQ(last, scale.n_bands() - 1);
  EXPECT_GT(last, 20);
}

TEST(Picture, ValuesAtVerticesAndInsideAreThoseOfTheShapeFunctions) {
  Frame frame = two_blocks();
  CellField stress(frame, 1, Field::s2), displacement(frame, 1, Field::displacement);
  for (const Vec2& x : {Vec2(0, 0), Vec2(1, 1), Vec2(0.5, 0), Vec2(0.3, 0.6)}) {  // from the first vertex
    EXPECT_NEAR(stress(x), -2e6, 1e-6);
    EXPECT_NEAR(displacement(x), 2e-3 * (2 + x.x()), 1e-15);
  }
}

TEST(Picture, ANumberOfABlockIsThatOfAllItsPoints) {
  Frame frame = two_blocks();
  ASSERT_EQ(field_named("rotation"), Field::of_blocks);
  EXPECT_FALSE(holds(frame, Field::of_blocks));
  frame.block_values["rotation"] = Eigen::Vector2d(-0.3, 0.2);
  ASSERT_TRUE(holds(frame, Field::of_blocks));
  for (const int b : {0, 1})
    for (const Vec2& x : {Vec2(0, 0), Vec2(0.3, 0.6)})
      EXPECT_EQ(CellField(frame, b, Field::of_blocks)(x), frame.block_values["rotation"][b]);
  const std::string svg = draw({{.frame = &frame, .field = Field::of_blocks}}, {});
  EXPECT_NE(texts(parsed(svg)).find("rotation (mrad)"), std::string::npos) << texts(parsed(svg));
}

/// Concave blocks are cut to be drawn, divided ones are drawn cell by cell: nothing is missing or doubled.
TEST(Picture, BlocksOfAnyShapeAreFilled) {
  const Mat2 gradient = (Mat2() << 1e-3, -3e-4, 2e-4, -5e-4).finished();
  Frame frame = linear_cell_frame(gradient, Vec3::Zero());
  for (FrameCell& cell : frame.cells) cell.elasticity = 0;
  const FieldSamples samples(frame, Field::sxx, 100);
  const double sxx = (frame.elasticity[0] * Vec3(1e-3, -5e-4, -1e-4))[0];
  EXPECT_NEAR(samples.range().low, sxx, 1e-9 * sxx);
  EXPECT_NEAR(samples.range().high, sxx, 1e-9 * sxx);
  SvgPage page;
  samples.draw(page, {{{0, 0}, {11, 3}}, {0, 0}, 100}, ColourScale(Field::sxx, {sxx, sxx}));
  const pugi::xml_document document = parsed(page.finish(1100, 300));
  double painted = 0, expected = 0;
  for (const pugi::xml_node& path : paths(document))
    for (const auto& polygon : polygons(path.attribute("d").value())) painted -= area(polygon);
  for (int b = 0; b < frame.n_blocks(); ++b) expected += polyfem::signed_area(frame.outline(b));
  EXPECT_NEAR(painted, 1e4 * expected, 1e-3 * painted);
}

/// What a divided block's cells have at their corners does not set the colours; of other blocks it does.
TEST(Picture, ColoursTellTheInsideOfCellsApart) {
  const Frame whole = wall(3, 2);
  Frame divided = random_cell_frame(9);
  divided.strain_displacement.leftCols(divided.cells[3].corners.first).setZero();  // of the other blocks
  const FieldSamples of_whole(whole, Field::s1, 100), of_divided(divided, Field::s1, 100);
  EXPECT_EQ(of_whole.telling_range(), of_whole.range());
  const ValueRange &all = of_divided.range(), &telling = of_divided.telling_range();
  EXPECT_TRUE(all.low <= telling.low && telling.low < telling.high && telling.high <= all.high);
  EXPECT_LT(telling.high - telling.low, all.high - all.low);
}

/// One brick of a thousand with a thousand times the stress, as at a corner that something cuts into.
TEST(Picture, APeakDoesNotTakeTheColours) {
  Frame frame = wall(40, 25);
  frame.strain_displacement.leftCols(4) *= 1e3;
  const FieldSamples samples(frame, Field::sxx, 20);
  EXPECT_TRUE(samples.has_peaks());
  EXPECT_LT(samples.telling_range().high - samples.telling_range().low,
            0.1 * (samples.range().high - samples.range().low));
  const std::string svg = draw({{.frame = &frame, .field = Field::sxx}}, {});
  const std::string said = texts(parsed(svg));
  for (const char* words : {"99 % of area", "min ", "max "})
    EXPECT_NE(said.find(words), std::string::npos) << said;
}

/// A stone on a slope, less than a hundredth of the area.
TEST(Picture, ASmallBlockKeepsItsColoursBesideALargeOneAtRest) {
  Frame frame = empty_frame();
  add_block(frame, box(0, 0, 20, 20), Mat2::Zero());
  add_block(frame, box(20, 20, 0.5, 0.5), stretch_x);
  for (const Field field : {Field::displacement, Field::velocity, Field::s1}) {
    const FieldSamples samples(frame, field, 20);
    EXPECT_EQ(samples.telling_range(), samples.range()) << description(field).name;
    const std::string said = texts(parsed(draw({{.frame = &frame, .field = field}}, {})));
    EXPECT_EQ(said.find("everywhere"), std::string::npos) << said;
  }
}

TEST(Picture, ConcaveCellsHaveTheirOwnFunctions) {
  const Frame frame = random_cell_frame(4);
  const int u_shape = 2;
  CellField field(frame, u_shape, Field::sxy);
  polyfem::ShapeValues shape;
  for (const Vec2& x : {Vec2(0.2, 2.7), Vec2(1.5, 0.2), Vec2(2.9, 2.9), Vec2(1, 1)}) {
    polyfem::mean_value(frame.outline(u_shape), x + Vec2(5, 0), shape);
    const Vec3 stress = CellView(frame, u_shape).stress(shape);
    EXPECT_NEAR(field(x), stress[2], 1e-9 * stress.norm());
  }
}

TEST(Picture, CellsAreOutlinedOnceWhereTheyAreLargeEnough) {
  const Frame frame = linear_cell_frame(Mat2::Identity(), Vec3::Zero());
  const auto edges = [&](double width) {
    PictureOptions options;
    options.width = width;
    const pugi::xml_document document = parsed(draw({{.frame = &frame}}, options));
    const auto path = document.select_node("//*[name()='path'][@stroke-opacity]").node();
    return polygons(path.attribute("d").value()).size();
  };
  EXPECT_EQ(edges(800), 11u);
  EXPECT_EQ(edges(60), 0u);
}

TEST(Picture, NamesStandInsideConcaveBlocks) {
  const Frame frame = cell_frame();
  for (int b = 0; b < frame.n_blocks(); ++b)
    EXPECT_TRUE(polyfem::contains(frame.outline(b), middle(frame, b))) << b;
  EXPECT_FALSE(polyfem::contains(frame.outline(2), polyfem::area_moments(frame.outline(2)).centroid));
}

TEST(Picture, IsTheSameFarFromTheOrigin) {
  const double far = 1 << 20;
  const Frame here = wall(3, 3), there = wall(3, 3, 1, Vec2(far, -far));
  const PictureOptions options = everything();
  EXPECT_EQ(draw({{.frame = &here, .field = Field::s1}}, options),
            draw({{.frame = &there, .field = Field::s1}}, options));
}

TEST(Picture, IsSoundWhateverTheFrameHolds) {
  std::vector<Frame> zoo = {
      two_blocks(), wall(4, 3), wall(3, 2, 1e-6), wall(3, 2, 1e6), wall(1, 1, 1, Vec2(1e6, 1e6)),
      wall(40, 1),  wall(1, 60)};
  Frame at_rest = empty_frame();
  add_block(at_rest, box(0, 0, 1, 1), Mat2::Zero());
  zoo.push_back(at_rest);
  Frame sliver = empty_frame();
  add_block(sliver, box(0, 0, 1, 1e-7), stretch_x);
  zoo.push_back(sliver);
  Frame concave = empty_frame();
  Points arrow(2, 4);
  arrow << 0, 2, 0, 0.5, 0, 1, 2, 1;
  add_block(concave, arrow, stretch_x);
  zoo.push_back(concave);
  Frame huge = two_blocks();
  huge.strain_displacement *= 1e250;
  huge.velocity *= 1e-300;
  zoo.push_back(huge);
  Frame broken = two_blocks();
  broken.strain_displacement(0, 1) = std::numeric_limits<double>::quiet_NaN();
  broken.velocity(0, 2) = std::numeric_limits<double>::infinity();
  zoo.push_back(broken);
  zoo.push_back(random_cell_frame(7));
  Frame crossed = two_blocks();
  crossed.position.col(1).swap(crossed.position.col(2));
  zoo.push_back(crossed);
  for (Frame& frame : zoo)
    for (const ContactState state : {ContactState::stick, ContactState::slip_forward})
      frame.contacts.push_back({0, 0, frame.position.col(1), {0, 1}, -1e-9, 5e3, -1e3, state});
  for (std::size_t i = 0; i < zoo.size(); ++i)
    for (const FieldDescription& field : all_fields()) {
      SCOPED_TRACE(std::to_string(i) + " " + field.name);
      if (field.field >= Field::of_blocks)
        for (Frame* frame : {&zoo[i], &zoo[0]})
          frame->block_values[field.name] = VectorXd::LinSpaced(frame->n_blocks(), -1, 2);
      expect_sound(draw({{.frame = &zoo[i], .field = field.field, .caption = "one"}}, everything()));
      expect_sound(draw({{&zoo[i], field.field, "left", {}, 0}, {&zoo[0], field.field, "right", {}, 1}}, {}));
    }
}

TEST(Picture, AnUnstressedSceneSaysSo) {
  Frame frame = empty_frame();
  add_block(frame, box(0, 0, 1, 1), Mat2::Zero());
  const std::string told = texts(parsed(draw({{.frame = &frame, .field = Field::s1}}, {})));
  EXPECT_NE(told.find("\u03c31 (Pa)"), std::string::npos) << told;
  EXPECT_NE(told.find("everywhere"), std::string::npos) << told;
}

TEST(Picture, PanelsShareColoursUnlessToldOtherwise) {
  const Frame weak = two_blocks();
  Frame strong = weak;
  strong.strain_displacement *= 3;
  const std::vector<Panel> panels = {{&weak, Field::sxx, "weak", {}, 0},
                                     {&strong, Field::sxx, "strong", {}, 0}};
  const auto n_titles = [&](const PictureOptions& options) {
    const std::string told = texts(parsed(draw(panels, options)));
    int n = 0;
    for (std::size_t at = 0; (at = told.find("\u03c3xx", at)) != std::string::npos; ++at) ++n;
    return n;
  };
  PictureOptions options;
  options.columns = 2;
  EXPECT_EQ(n_titles(options), 1);
  options.sharing = RangeSharing::none;
  EXPECT_EQ(n_titles(options), 2);
  options.sharing = RangeSharing::rows;
  EXPECT_EQ(n_titles(options), 1);
  options.columns = 1;
  EXPECT_EQ(n_titles(options), 2);
  // The strongest colour belongs to the strongest value of all panels.
  options.sharing = RangeSharing::all;
  const ColourScale scale(Field::sxx, {-6e6, 3e6});
  EXPECT_EQ(filled(parsed(draw(panels, options)), scale.colour(scale.band(-6e6))).size(), 1u);
  EXPECT_EQ(filled(parsed(draw(panels, options)), scale.colour(scale.band(1e6))).size(), 1u);
}

TEST(Picture, ArrowsAreAsLongAsTheirSampleSays) {
  Frame frame = two_blocks();
  frame.contacts.push_back({1, 0, Vec2(0.5, 0.5), {0, 1}, 0, 30e3, 40e3, ContactState::stick});
  PictureOptions options;
  options.vectors = {VectorKind::contact_forces};
  const pugi::xml_document document = parsed(draw({{.frame = &frame}}, options));
  std::vector<double> lengths;
  std::vector<Vec2> directions;
  for (const pugi::xml_node& path : paths(document))
    for (const auto& polygon : polygons(path.attribute("d").value()))
      if (polygon.size() == 7) {  // tail, neck, tip, neck, tail
        directions.push_back(polygon[3] - (polygon[0] + polygon[6]) / 2);
        lengths.push_back(directions.back().norm());
      }
  ASSERT_EQ(lengths.size(), 2u);  // the force and the sample
  EXPECT_NE(texts(document).find("50 kN/m contact force"), std::string::npos) << texts(document);
  EXPECT_NEAR(lengths[0], lengths[1], 0.05);
  // The normal up, shear along the normal turned left; y is downwards on the page.
  EXPECT_NEAR(directions[0].x() / lengths[0], -0.8, 1e-3);
  EXPECT_NEAR(directions[0].y() / lengths[0], -0.6, 1e-3);
}

TEST(Picture, MagnifiedFramesMoveFurtherAndKeepTheirFields) {
  Frame frame = two_blocks();
  frame.contacts.push_back(
      {1, 0, frame.position.col(frame.blocks[1].first), {1, 0}, 0, 30e3, 0, ContactState::stick});
  const Frame drawn = magnified(frame, 3);
  EXPECT_NEAR((drawn.position - frame.position - 2 * frame.displacement).norm(), 0, 1e-12);
  EXPECT_EQ(drawn.contacts[0].position, Vec2(drawn.position.col(drawn.blocks[1].first)));
  // Neither the range of the colours nor the colours change, only the points.
  const FieldSamples values(frame, Field::sxx, 100), moved(frame, Field::sxx, 100, drawn);
  EXPECT_EQ(values.range().low, moved.range().low);
  EXPECT_EQ(values.range().high, moved.range().high);
  const pugi::xml_document document =
      parsed(draw({{.frame = &drawn, .field = Field::sxx, .values = &frame}}, {}));
  const pugi::xml_document plain = parsed(draw({{.frame = &frame, .field = Field::sxx}}, {}));
  EXPECT_NE(outlines(document)[0], outlines(plain)[0]);
  EXPECT_EQ(magnified(frame, 1).position, frame.position);
}

TEST(Picture, ArrowsBeyondTheBlocksDoNotReachTheLegend) {
  Frame frame = two_blocks();
  frame.contacts.push_back({1, 0, Vec2(0.5, 0), {1, 0}, 0, 0, -30e3, ContactState::stick});
  PictureOptions options;
  options.vectors = {VectorKind::contact_forces};
  const pugi::xml_document document = parsed(draw({{.frame = &frame}}, options));
  double lowest = 0;
  for (const pugi::xml_node& path : paths(document))
    if (path.attribute("paint-order"))
      for (const auto& polygon : polygons(path.attribute("d").value()))
        if (std::abs(polygon[3].x() - polygon[0].x()) < 2) lowest = std::max(lowest, polygon[3].y());
  const auto bar =
      polygons(document.select_node("//*[name()='path'][@stroke-width='1.2']").node().attribute("d").value());
  EXPECT_GT(lowest, outlines(document)[0][0].y() + 20);
  EXPECT_LT(lowest, bar[0][0].y());
}

TEST(Picture, ScenesOfUnlikeSizeHaveEachTheirScale) {
  const Frame small = wall(2, 2), large = wall(2, 2, 50), similar = wall(2, 2, 1.5);
  EXPECT_NE(texts(parsed(draw({{&small, Field::none, "", {}, 0}, {&large, Field::none, "", {}, 1}}, {})))
                .find("0.2 m\n10 m"),
            std::string::npos);
  const std::string one =
      texts(parsed(draw({{&small, Field::none, "", {}, 0}, {&similar, Field::none, "", {}, 1}}, {})));
  EXPECT_EQ(std::count(one.begin(), one.end(), '\n'), 1) << one;
}

TEST(Picture, TheScaleBarIsToScaleBesideALongLegend) {
  Frame frame = wall(1, 40);
  frame.contacts.push_back({0, 0, Vec2(0, 0), {0, 1}, 0, 5e3, -1e3, ContactState::slip_forward});
  PictureOptions options = everything();
  options.reference = false;
  const pugi::xml_document document = parsed(draw({{.frame = &frame}}, options));
  const auto shapes = outlines(document);
  ASSERT_EQ(shapes.size(), 40u);
  const double metre = (shapes[38][0] - shapes[0][0]).norm() / 19;
  const auto bar =
      polygons(document.select_node("//*[name()='path'][@stroke-width='1.2']").node().attribute("d").value());
  ASSERT_EQ(bar.size(), 3u);
  EXPECT_NE(texts(document).find("\n0.5 m\n"), std::string::npos) << texts(document);
  EXPECT_NEAR((bar[1][1] - bar[1][0]).norm(), metre / 2, 0.02);
}

TEST(Picture, AThousandBlocksMakeASmallFile) {
  const Frame frame = wall(40, 25);
  EXPECT_LT(draw({{.frame = &frame, .field = Field::s1}}, {}).size(), 2'500'000u);
}

TEST(Picture, WhatAFrameDoesNotHoldIsRefused) {
  Frame frame = two_blocks();
  frame.strain_displacement.resize(2, 0);
  EXPECT_THROW(draw({{.frame = &frame, .field = Field::s1}}, {}), Error);
  EXPECT_NO_THROW(draw({{.frame = &frame, .field = Field::velocity}}, {}));
  EXPECT_THROW(draw(std::vector<Panel>{}, PictureOptions{}), Error);
  frame.displacement.resize(2, 0);
  PictureOptions options;
  options.reference = true;
  EXPECT_THROW(draw({{.frame = &frame}}, options), Error);
}

TEST(Picture, OfARunShowsItsFieldsAndContacts) {
  BuiltScene built = build_example("paper/arch_friction30.toml");
  ASSERT_TRUE(run(*built.stepper, 20));
  const Frame frame = capture_frame(*built.stepper, built.labels, {});
  const std::vector<std::string>& names = built.labels.block_names;
  const std::string svg = draw(
      {{&frame, Field::s1, "step 20", names, 0}, {&frame, Field::s2, "step 20", names, 0}}, everything());
  expect_sound(svg);
  const std::string told = texts(parsed(svg));
  for (const char* word : {"crown", "left_haunch", "step 20", "contact force", "compression"})
    EXPECT_NE(told.find(word), std::string::npos) << word;
}

}  // namespace
