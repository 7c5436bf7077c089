# SPDX-License-Identifier: Apache-2.0
# Commands of ./do for browsers and node; sourced by ./do.

# Builds the programs for the demo in build/web/programs, with one SIMD target and few optimizations, which takes less
# than half of the time of a release build. Sets $PROGRAM and $LAB.
build_demo_programs() {
  BUILD=build/web/programs PROGRAM=build/web/programs/starfocus LAB=build/web/programs/starfocus-lab
  step configure-demo "configuring $BUILD" cmake -S . -B $BUILD -G Ninja -DCMAKE_BUILD_TYPE=Release \
    '-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG' -DSTARFOCUS_STATIC_DISPATCH=ON -DSTARFOCUS_TESTS=OFF
  step build-demo "building starfocus and starfocus-lab in $BUILD" \
    cmake --build $BUILD --parallel "$(nproc)" --target starfocus starfocus_lab
}

# Makes the demo of the page in the folder $1: five views as JPEG, and their disparities. The page needs small files for
# slow connections: PNG views and disparity.pfm have 9.4 MB, the demo has 2.2 MB. The centre view, which the page shows,
# has the best quality.
make_web_demo() {
  local views=build/web/demo view quality start BUILD=$BUILD PROGRAM=$PROGRAM LAB=$LAB
  [ -x $PROGRAM ] && [ -x $LAB ] || build_demo_programs
  lab "made the light field $views" scene $views --name portrait --views 5
  start=$SECONDS
  rm -rf "$1"
  mkdir -p "$1" || exit 1
  for view in $views/view_*.png; do
    quality=90
    [ $view != $views/view_+0.0_+0.0.png ] || quality=95
    $PROGRAM refocus $view --depth $views/disparity.pfm --depth-unit disparity --no-repair --focus 0 --strength 0 \
      --quality $quality -o "$1/$(basename $view .png).jpg" >/dev/null || fail "converting $view: failed"
  done
  cp $views/meta.txt "$1" || exit 1
  node toolchains/demo_disparities.mjs $views/disparity.pfm "$1" || fail "converting the disparities: failed"
  printf 'made the demo %s (%d s)\n' "$1" $((SECONDS - start))
}

# Fetches version $2 of the npm package $1 once. Prints the folder of the package, and returns 0, if its files have the
# checksums on stdin.
fetch_package() {
  local fetched=build/web/fetched/$1 sums
  sums=$(cat)
  has_files() { (cd "$fetched/node_modules/$1" && printf '%s\n' "$sums" | sha256sum --check --status) 2>/dev/null; }
  has_files "$1" || npm install --prefix "$fetched" --no-save --prefer-offline --no-audit --no-fund --ignore-scripts \
    "$1@$2" >/dev/null 2>&1
  echo "$fetched/node_modules/$1"
  has_files "$1"
}

# Copies the decoder of HEIC files to the folder $1. The page works without the decoder, but opens no HEIC depth photos.
add_heic_decoder() {
  local package version=1.23.2
  rm -rf "$1"
  if ! package=$(fetch_package libheif-js $version); then
    echo "note: the page opens no HEIC depth photos, because npm cannot fetch libheif-js $version"
    return
  fi <<SUMS
f148d9ff173e5a6d6781e80dccb8336f54bfbb032392ceb2d37e0e92923c4bf3  libheif-wasm/libheif.js
e4aa8333fbe55ec7c6c776f735236f40bed9103188498f8131d4e52b73cdfee8  libheif-wasm/libheif.wasm
SUMS
  mkdir -p "$1" && cp $package/libheif-wasm/libheif.js $package/libheif-wasm/LICENSE "$1" &&
    gzip -9nc $package/libheif-wasm/libheif.wasm >"$1/libheif.wasm.gzip" || exit 1
}

# Copies the segmenter, which finds people in photos, to the folder $1. The page works without the segmenter, but opens
# no photos without depth or matte. The package has the licence of this project and contains no copy of the licence.
add_segmenter() {
  local package version=0.1.1675465747 name=selfie_segmentation file
  rm -rf "$1"
  if ! package=$(fetch_package @mediapipe/$name $version); then
    echo "note: the page opens no photos without depth, because npm cannot fetch @mediapipe/$name $version"
    return
  fi <<SUMS
a4720d2d2374ec9df3510461ff186a4af427fb5bd402375e135875a991467da3  selfie_segmentation.js
0007be42c754f111063c0121bba7104880b7c56277d3a9681cdcb17709236aee  selfie_segmentation.binarypb
8d13b7fae74af625c641226813616a2117bd6bca19eb3b75574621fc08557f27  selfie_segmentation.tflite
9406e7e30843bdca189689d4bea413f3e468f71e381560e583ef12792d26d46a  selfie_segmentation_solution_simd_wasm_bin.js
d93e73677ef1fe791ff5407083c0f9ced6d6050a705bd6c20823fc05919d8dc4  selfie_segmentation_solution_simd_wasm_bin.wasm
SUMS
  mkdir -p "$1" && cp LICENSE $package/package.json "$1" || exit 1
  for file in $name.js $name.binarypb $name.tflite ${name}_solution_simd_wasm_bin.js ${name}_solution_simd_wasm_bin.wasm; do
    gzip -9nc $package/$file >"$1/$file.gzip" || exit 1
  done
}

# Builds the npm package in build/web/npm, and the page with the package and a demo in build/web/site. The demo is made
# only if the demo is missing. The programs of the release build make the demo if these programs exist.
build_web() {
  local site=build/web/site
  NODE_PATH=/usr/share/nodejs step configure-web "configuring build/web" cmake --preset web
  NODE_PATH=/usr/share/nodejs step build-web "building the npm package in build/web/npm" \
    cmake --build --preset web --parallel "$(nproc)"
  [ -f $site/demo/disparity.json ] || make_web_demo $site/demo
  rm -rf $site/starfocus
  cp -r build/web/npm $site/starfocus || exit 1
  add_heic_decoder $site/heic
  add_segmenter $site/segmenter
  cp examples/web/*.html examples/web/*.css examples/web/*.js platform/web/worker/png16.js $site || exit 1
}

# web [PORT]: serves the page on the loopback interface. `web build` only builds the page; `web test` tests the package
# and the page.
web() {
  local port=8080
  case "${1:-}" in
    '' | build) ;;
    test) PACKAGES="$PACKAGES chromium" ;;
    *[!0-9]*) fail "usage: ./do web [PORT | build | test]" ;;
    *) port=$1 ;;
  esac
  PACKAGES="$PACKAGES emscripten esbuild nodejs npm"
  install_missing
  [ "${1:-}" != test ] || build starfocus starfocus_lab
  build_web
  case "${1:-}" in
    build) echo "the page: build/web/site; the package: build/web/npm" ;;
    test) tests/web/run.sh $BUILD build/web || exit 1 ;;
    *) node examples/web/serve.mjs build/web/site $port ;;
  esac
}
