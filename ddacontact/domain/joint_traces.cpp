#include <ddacontact/domain/joint_traces.hpp>

#include <polyfem/geometry/validity.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace ddacontact {

namespace {

using polyfem::Segment;

/// Numbers of a normal distribution, by Box and Muller: those of <random> differ from library to library.
class NormalNumbers {
 public:
  explicit NormalNumbers(std::uint64_t seed) : random_(seed) {}
  /// The mean itself where the deviation is 0.
  double operator()(double mean, double deviation) {
    if (deviation == 0) return mean;
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return mean + deviation * radius * std::cos(2 * std::numbers::pi * uniform());
  }
  /// At least a tenth of the mean.
  double length(double mean, double deviation) { return std::max((*this)(mean, deviation), mean / 10); }

 private:
  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  std::mt19937_64 random_;
};

Vec2 direction(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {std::cos(angle), std::sin(angle)};
}

/// The box of a polygon along and across the traces, from the origin of the set.
struct Extent {
  double begin, end, low, high;

  Extent(const JointSet& set, const PointsRef& place) {
    const Vec2 along = direction(set.angle), across(-along.y(), along.x());
    const VectorXd t = (place.colwise() - set.origin).transpose() * along,
                   n = (place.colwise() - set.origin).transpose() * across;
    const double size = std::max(t.maxCoeff() - t.minCoeff(), n.maxCoeff() - n.minCoeff()),
                 turned = size * std::sin(std::min(90.0, 3 * set.angle_deviation) * std::numbers::pi / 180);
    begin = t.minCoeff() - size;
    end = t.maxCoeff() + size;
    low = n.minCoeff() - turned;
    high = n.maxCoeff() + turned;
  }
};

class TraceMaker {
 public:
  TraceMaker(const JointSet& set, const Extent& extent, std::uint64_t seed, int mark)
      : set_(set),
        extent_(extent),
        along_(direction(set.angle)),
        across_(-along_.y(), along_.x()),
        normal_(seed),
        mark_(mark) {}

  std::vector<Segment> make() {
    const double first = std::floor(extent_.low / set_.spacing);
    double beyond = 0;  // what drawn spacings differ by
    for (double k = first; k * set_.spacing + beyond <= extent_.high; ++k) {
      add_line(k * set_.spacing + beyond, std::fmod(k, 2) != 0);
      beyond += normal_.length(set_.spacing, set_.spacing_deviation) - set_.spacing;
    }
    return std::move(traces_);
  }

 private:
  void add_line(double level, bool is_odd) {
    if (set_.gap == 0 && set_.gap_deviation == 0)  // a persistent joint: its traces go on into each other
      return add_trace(level, extent_.begin, extent_.end);
    const double period = set_.trace + set_.gap, shift = is_odd ? period / 2 : 0;
    const double first = std::floor((extent_.begin - shift + set_.trace / 2) / period);
    double beyond = 0;
    for (double j = first;; ++j) {
      const double begin = shift + j * period - set_.trace / 2 + beyond;
      if (begin > extent_.end) return;
      const double length = normal_.length(set_.trace, set_.trace_deviation),
                   gap = std::max(0.0, normal_(set_.gap, set_.gap_deviation));
      add_trace(level, begin, begin + length);
      beyond += length + gap - period;
    }
  }

  void add_trace(double level, double begin, double end) {
    begin = std::max(begin, extent_.begin);
    end = std::min(end, extent_.end);
    const double turn = normal_(0, set_.angle_deviation);
    if (!(begin < end)) return;
    const Vec2 middle = set_.origin + (begin + end) / 2 * along_ + level * across_,
               half = (end - begin) / 2 * (turn == 0 ? along_ : direction(set_.angle + turn));
    traces_.push_back({middle - half, middle + half, mark_});
  }

  const JointSet& set_;
  const Extent& extent_;
  const Vec2 along_, across_;
  NormalNumbers normal_;
  int mark_;
  std::vector<Segment> traces_;
};

}  // namespace

double n_joint_traces(const JointSet& set, const PointsRef& place) {
  const Extent extent(set, place);
  return ((extent.high - extent.low) / set.spacing + 1) *
         ((extent.end - extent.begin) / (set.trace + set.gap) + 1);
}

std::vector<Segment> joint_traces(const JointSet& set, const PointsRef& place, std::uint64_t seed, int mark) {
  return TraceMaker(set, Extent(set, place), seed, mark).make();
}

std::vector<Segment> parts_inside(const Segment& segment, const PointsRef& polygon) {
  std::vector<double> crossings{0, 1};
  const Vec2 along = segment.to - segment.from;
  for (Index k = 0; k < polygon.cols(); ++k) {
    const Vec2 a = polygon.col(k), edge = polygon.col((k + 1) % polygon.cols()) - a;
    const double across = polyfem::cross(along, edge);
    if (across == 0) continue;
    const double t = polyfem::cross(a - segment.from, edge) / across,
                 s = polyfem::cross(a - segment.from, along) / across;
    if (t > 0 && t < 1 && s >= 0 && s <= 1) crossings.push_back(t);
  }
  std::ranges::sort(crossings);
  std::vector<Segment> parts;
  for (std::size_t k = 0; k + 1 < crossings.size(); ++k) {
    const double begin = crossings[k], end = crossings[k + 1];
    if (begin < end && polyfem::contains(polygon, segment.from + (begin + end) / 2 * along))
      parts.push_back({segment.from + begin * along, segment.from + end * along, segment.mark});
  }
  return parts;
}

}  // namespace ddacontact
