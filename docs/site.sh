#!/bin/bash
# Builds the site from the Markdown pages: bash docs/site.sh [BUILD_FOLDER]; the output is in build/site.
# Needs mkdocs and its material theme (Debian: apt-get install mkdocs mkdocs-material); without them a word, and nothing is built.
# Pages open from the disk; the search needs a server: python3 -m http.server -d build/site
set -euo pipefail
project=$(cd "$(dirname "$0")/.." && pwd)
build=${1:-$project/build}
mkdir -p "$build"
if ! /usr/bin/python3 -c 'import yaml' 2> /dev/null; then
  echo "skipped: Python's yaml is missing (apt-get install python3-yaml)"
  exit 0
fi
/usr/bin/python3 -B "$project/docs/site/build.py" "$project" "$build"
if ! command -v mkdocs > /dev/null || ! /usr/bin/python3 -c 'import mkdocs.utils as u, sys; sys.exit("material" not in u.get_theme_names())' 2> /dev/null; then
  echo "skipped: mkdocs or its material theme is missing (apt-get install mkdocs mkdocs-material); pages are in $build/site_pages"
  exit 0
fi
mkdocs build --strict --clean --quiet -f "$build/mkdocs.yml"
echo "the site is in $build/site: open $build/site/index.html"
