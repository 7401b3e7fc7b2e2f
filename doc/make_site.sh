#!/usr/bin/env bash
# Makes the site from doc/: bash doc/make_site.sh [OUTPUT], by default build/site. On Debian 12; works offline when made.
# Interfaces are Doxygen's own pages, in OUTPUT/api: they are complete and have a search of their own, which Breathe's are not.
set -euo pipefail
cd "$(dirname "$0")/.."
source tests/support/debian_packages.sh
install_packages "${site_packages[@]}"
output=$(realpath --canonicalize-missing "${1:-build/site}")
/usr/bin/python3 -m sphinx -E -a -W --keep-going -q -c doc/site -d "$output.doctrees" doc "$output"
# Debian's Furo expects a web server's folders and a bundler.
esbuild "$output/_static/scripts/furo.js" --bundle --minify --log-level=warning --allow-overwrite --outfile="$output/_static/scripts/furo.js"
cp /usr/share/javascript/normalize.css/normalize.css "$output/_static/styles/"
sed -i 's|/javascript/normalize.css/||' "$output/_static/styles/furo.css"
mathjax=/usr/share/javascript/mathjax
for part in MathJax.js config/TeX-AMS_CHTML.js extensions jax/element jax/input/TeX jax/output/CommonHTML fonts/HTML-CSS/TeX/woff; do
  mkdir -p "$output/_static/mathjax/$(dirname "$part")"
  cp -rL "$mathjax/$part" "$output/_static/mathjax/$(dirname "$part")"
done
cmake -DDOXYGEN=/usr/bin/doxygen -DSOURCE="$PWD" -DOUTPUT="$output.api" -P doc/run_doxygen.cmake
rm -rf "$output/api"
mv "$output.api/html" "$output/api"
echo "The site: $output/index.html"
