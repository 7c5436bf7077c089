# SPDX-License-Identifier: Apache-2.0
# Command of ./do that makes the site; sourced by ./do.

# make_gallery FOLDER: runs the commands of gallery.md in the folder.
make_gallery() {
  rm -rf "$1"
  mkdir -p "$1" && PATH="$PWD/$BUILD:$PATH" python3 toolchains/site/gallery.py toolchains/site/gallery.md "$1"
}

# copy_reference FOLDER: copies the pages of doxygen, and links the name of the project to the start page.
copy_reference() {
  cp -r build/docs/html "$1" &&
    sed -i 's|id="projectname">starfocus|id="projectname"><a href="../index.html">starfocus</a>|' "$1"/*.html &&
    grep -q 'href="../index.html"' "$1/files.html"
}

# copy_page FOLDER: copies the page to tap, and links the name of the project to the start page.
copy_page() {
  cp -r build/web/site "$1" &&
    sed -i 's|<h1>starfocus</h1>|<h1><a href="../index.html">starfocus</a></h1>|' "$1/index.html" &&
    grep -q 'href="../index.html"' "$1/index.html"
}

# site: makes the static folder build/site from the documents, the reference, the gallery and the page to tap. Fails if
# a link of the site is broken.
site() {
  local site=build/site
  require doxygen cmark-gfm python3
  build starfocus starfocus_lab
  docs
  [ -f build/web/site/index.html ] || ./do web build || exit 1
  rm -rf $site
  step gallery "making the pictures of the gallery" make_gallery build/gallery
  step pages "making the pages in $site" python3 toolchains/site/pages.py $site build/gallery
  step reference "copying the reference" copy_reference $site/reference
  step tap "copying the page to tap" copy_page $site/tap
  python3 toolchains/site/links.py $site || fail "$site has broken links"
  echo "the site: $site/index.html"
}
