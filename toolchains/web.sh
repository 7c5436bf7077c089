# SPDX-License-Identifier: Apache-2.0
# Commands of ./do for browsers and node; sourced by ./do.

# Builds the npm package in build/web/npm, and the page with the package and a demo light field in build/web/site. The
# demo light field takes the most time and is rendered only once.
build_web() {
  local site=build/web/site
  NODE_PATH=/usr/share/nodejs step configure-web "configuring build/web" cmake --preset web
  NODE_PATH=/usr/share/nodejs step build-web "building the npm package in build/web/npm" \
    cmake --build --preset web --parallel "$(nproc)"
  mkdir -p $site/demo
  [ -f $site/demo/meta.txt ] || {
    build starfocus_lab
    lab "made the light field $site/demo" scene $site/demo --name portrait --views 5
  }
  rm -rf $site/starfocus
  cp -r build/web/npm $site/starfocus || exit 1
  cp examples/web/*.html examples/web/*.css examples/web/*.js $site || exit 1
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
  build_web
  case "${1:-}" in
    build) echo "the page: build/web/site; the package: build/web/npm" ;;
    test)
      build starfocus starfocus_lab
      tests/web/run.sh $BUILD build/web || exit 1
      ;;
    *) node examples/web/serve.mjs build/web/site $port ;;
  esac
}
