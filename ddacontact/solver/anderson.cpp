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
    const Index k = n_++ % depth_;
    dy_.col(k) = x - last_y_;
    df_.col(k) = f - last_f_;
  }
  last_y_ = x;
  last_f_ = f;
  if (const Index n = std::min(n_, depth_); n > 0) {
    const VectorXd gamma = df_.leftCols(n).colPivHouseholderQr().solve(f);
    x.noalias() -= dy_.leftCols(n) * gamma;
  }
  return f.squaredNorm();
}

}  // namespace ddacontact
