#include <ddacontact/solver/anderson.hpp>

#include <Eigen/QR>

namespace ddacontact {

void AndersonAcceleration::reset() {
  dx_.clear();
  df_.clear();
  last_x_.resize(0);
}

void AndersonAcceleration::advance(const VectorXd& f, const VectorXd& weights, VectorXd& x) {
  if (last_x_.size() == x.size()) {
    dx_.push_back(x - last_x_);
    df_.push_back(f - last_f_);
    if (dx_.size() > depth_) {
      dx_.erase(dx_.begin());
      df_.erase(df_.begin());
    }
  }
  last_x_ = x;
  last_f_ = f;
  x += f;
  if (df_.empty()) return;

  MatrixXd dF(f.size(), static_cast<Index>(df_.size()));
  for (std::size_t k = 0; k < df_.size(); ++k) dF.col(k) = df_[k].cwiseProduct(weights);
  const VectorXd gamma = dF.colPivHouseholderQr().solve(f.cwiseProduct(weights));
  for (std::size_t k = 0; k < df_.size(); ++k) x -= gamma[k] * (dx_[k] + df_[k]);
}

}  // namespace ddacontact
