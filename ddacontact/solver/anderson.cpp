#include <ddacontact/solver/anderson.hpp>

#include <Eigen/QR>

#include <algorithm>

namespace ddacontact {

void AndersonAcceleration::reset() {
  n_ = 0;
  last_y_.resize(0);
}

double AndersonAcceleration::advance(const VectorXd& f, VectorXd& x) {
  if (last_y_.size() == x.size()) {
    dy_.resize(x.size(), depth_);
    df_.resize(f.size(), depth_);
    products_.resize(depth_, depth_);
    const Index k = n_++ % depth_, n = std::min(n_, depth_);
    dy_.col(k) = x - last_y_;
    df_.col(k) = f - last_f_;
    products_.col(k).head(n).noalias() = df_.leftCols(n).transpose() * df_.col(k);
    products_.row(k).head(n) = products_.col(k).head(n).transpose();
  }
  last_y_ = x;
  last_f_ = f;
  if (const Index n = std::min(n_, depth_); n > 0) {
    // The normal equations, each difference as long as 1, and what their round-off leaves of f once more.
    const VectorXd lengths = products_.diagonal().head(n).cwiseSqrt(),
                   scale = (lengths.array() > 0).select(lengths.cwiseInverse(), 0.);
    const Eigen::ColPivHouseholderQR<MatrixXd> normal(scale.asDiagonal() * products_.topLeftCorner(n, n) *
                                                      scale.asDiagonal());
    VectorXd gamma = VectorXd::Zero(n), left = f;
    for (int k = 0; k < 2; ++k) {
      gamma += scale.cwiseProduct(normal.solve(scale.cwiseProduct(df_.leftCols(n).transpose() * left)));
      if (k == 0) left.noalias() -= df_.leftCols(n) * gamma;
    }
    x.noalias() -= dy_.leftCols(n) * gamma;
  }
  return f.squaredNorm();
}

}  // namespace ddacontact
