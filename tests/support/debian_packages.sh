# Packages of Debian 12 by what they are for; sourced by the scripts that set up a machine.

program_packages=(g++ cmake ninja-build libeigen3-dev libsuitesparse-dev libopenblas-dev libtomlplusplus-dev
  libcli11-dev libfmt-dev libspdlog-dev nlohmann-json3-dev libgeos-dev libdeflate-dev libpugixml-dev
  pkg-config librsvg2-dev fonts-dejavu-core)
python_packages=(python3-dev pybind11-dev python3-numpy python3-matplotlib python3-pytest)
# To change the page of `dda view`: its sources are TypeScript.
viewer_packages=(esbuild node-typescript)
site_packages=(python3-sphinx furo node-normalize.css python3-myst-parser libjs-mathjax doxygen esbuild)
test_packages=(clang libomp-dev libgtest-dev libbenchmark-dev libdeal.ii-dev libbox2d-dev libcgal-dev libboost-dev
  libglpk-dev doxygen python3-vtk9 chromium codespell python3-jsonschema)

# Installs those of the named packages that are missing; as root, or through sudo.
install_packages() {
  local missing=() package
  for package in "$@"; do
    dpkg-query --show --showformat='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' ||
      missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return
  local root=()
  [ "$(id -u)" -eq 0 ] || root=(sudo)
  "${root[@]}" apt-get update
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends "${missing[@]}"
}
