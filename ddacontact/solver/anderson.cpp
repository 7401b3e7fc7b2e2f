#include <ddacontact/solver/anderson.hpp>

#include <Eigen/QR>

#include <algorithm>
#include <limits>

namespace ddacontact {

void AndersonAcceleration::reset() {
  n_ = 0;
  last_y_.resize(0);
}

double AndersonAcceleration::advance(const VectorXd& f, VectorXd& x) {
  const Index depth = gram_.rows();
  if (last_y_.size() == x.size()) {
    dy_.resize(x.size(), depth);
    df_.resize(f.size(), depth);
    const Index k = n_++ % depth, n = std::min(n_, depth);
    dy_.col(k) = x - last_y_;
    df_.col(k) = f - last_f_;
    gram_.col(k).head(n).noalias() = df_.leftCols(n).transpose() * df_.col(k);
    gram_.row(k).head(n) = gram_.col(k).head(n).transpose();
    along_.head(n) += gram_.col(k).head(n);
    along_[k] = df_.col(k).dot(f);
  }
  last_y_ = x;
  last_f_ = f;
  if (const Index n = std::min(n_, depth); n > 0) {
    const VectorXd size = gram_.diagonal().head(n).cwiseSqrt().cwiseMax(std::numeric_limits<double>::min());
    const MatrixXd relative =
        size.asDiagonal().inverse() * gram_.topLeftCorner(n, n) * size.asDiagonal().inverse();
    const VectorXd gamma = relative.completeOrthogonalDecomposition()
                               .solve(along_.head(n).cwiseQuotient(size))
                               .cwiseQuotient(size);
    x.noalias() -= dy_.leftCols(n) * gamma;
  }
  return f.squaredNorm();
}

}  // namespace ddacontact
