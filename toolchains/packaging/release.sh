# SPDX-License-Identifier: Apache-2.0
# Command of ./do that makes the files of a release; sourced by ./do.

DEBIAN_ARCHITECTURES="arm64 armhf" # in addition to the architecture of this machine

# Prints the newest version in CHANGELOG.md and its date, or `unreleased`.
newest_version() {
  sed -n 's/^## \[\([0-9.]*\)\] - \(.*\)$/\1 \2/p' CHANGELOG.md | head -n 1
}

# archive_source FOLDER VERSION: packs the files of HEAD, with the time of the commit.
archive_source() {
  git archive --prefix="starfocus-$2/" HEAD | gzip -9n >"$1/starfocus-$2.tar.gz"
}

# pack_npm FOLDER: packs the npm package of build/web/npm. npm publishes a package with provenance only if package.json
# names the repository, whose address is in the environment variable STARFOCUS_REPOSITORY.
pack_npm() {
  local folder=$1/npm copy
  mkdir -p "$folder" && folder=$(realpath "$folder") && copy=$folder/package || return
  cp -r build/web/npm "$copy"
  if [ -n "${STARFOCUS_REPOSITORY:-}" ]; then
    (cd "$copy" && npm pkg set repository.type=git "repository.url=git+$STARFOCUS_REPOSITORY" \
      "homepage=$STARFOCUS_REPOSITORY#readme")
  else
    echo "note: package.json names no repository, because STARFOCUS_REPOSITORY is not set"
  fi
  (cd "$copy" && npm pack --pack-destination "$folder") && rm -r "$copy"
}

# pack_aar FOLDER VERSION: packs the Android archive, which requires an NDK.
pack_aar() {
  if [ -z "${ANDROID_NDK_HOME:-}" ]; then
    echo "note: no AAR was made, because ANDROID_NDK_HOME does not name an NDK"
    return
  fi
  toolchains/sysroot.sh headers build/sysroot/headers && cmake --preset android-arm64 &&
    cmake --build --preset android-arm64 --parallel "$(nproc)" --target starfocus_jni &&
    javac --release 8 -d build/android-classes $(find platform/java/src -name '*.java') &&
    jar --create --date="$(date -u -d "@$SOURCE_DATE_EPOCH" +%Y-%m-%dT%H:%M:%SZ)" --file build/classes.jar \
      -C build/android-classes dev &&
    mkdir "$1/android" && platform/java/aar.sh "$1/android/starfocus-$2.aar" build/classes.jar arm64-v8a=build/android-arm64/libstarfocus_jni.so
}

# describe_files FOLDER VERSION: writes the list of parts (SPDX) and the checksums of the files in FOLDER.
describe_files() {
  python3 toolchains/packaging/sbom.py "$1" "$2" "$(git rev-parse HEAD)" >"$LOGS/sbom.json" &&
    mv "$LOGS/sbom.json" "$1/starfocus-$2.spdx.json" &&
    (cd "$1" && find . -type f ! -name SHA256SUMS -printf '%P\n' | sort | xargs sha256sum) >"$LOGS/SHA256SUMS" &&
    mv "$LOGS/SHA256SUMS" "$1"
}

# make_release FOLDER VERSION: clones HEAD into FOLDER, and makes the files of the release in FOLDER/files.
make_release() {
  local clone=$1/starfocus files architecture
  rm -rf "$1"
  mkdir -p "$1/files" && files=$(realpath "$1/files") && git clone -q . "$clone" || exit 1
  # Installing the compilers for other architectures takes minutes, and is the same for every clone.
  mkdir "$clone/build"
  for architecture in $DEBIAN_ARCHITECTURES; do
    mkdir -p "build/cross-$architecture" && ln -s "$(realpath "build/cross-$architecture")" "$clone/build" || exit 1
  done
  (
    cd "$clone" || exit 1
    SOURCE_DATE_EPOCH=$(git log -1 --format=%ct) && export SOURCE_DATE_EPOCH
    step source "packing the source" archive_source "$files" "$2"
    for architecture in '' $DEBIAN_ARCHITECTURES; do (./do package $architecture) || exit 1; done
    (./do wheel) && (./do web build) || exit 1
    mkdir "$files/debian" "$files/python" && cp build/packages*/*.deb "$files/debian" &&
      cp build/wheel/starfocus-* "$files/python" || exit 1
    step npm "packing the npm package" pack_npm "$files"
    step aar "packing the AAR" pack_aar "$files" "$2"
    grep -h '^note: ' "$LOGS/npm.log" "$LOGS/aar.log"
    step describe "writing SPDX and checksums" describe_files "$files" "$2"
  ) || exit 1
}

# dry_run VERSION: makes the files that need no compilation in build/release-dry-run, and compares the ABI.
dry_run() {
  local folder=build/release-dry-run
  rm -rf $folder
  mkdir -p $folder
  step source "packing the source" archive_source $folder "$1"
  [ ! -d build/web/npm ] || step npm "packing the npm package" pack_npm $folder
  step describe "writing SPDX and checksums" describe_files $folder "$1"
  step abi "comparing the ABI with the last release" toolchains/packaging/compare_abi.sh
  tail -n 1 "$LOGS/abi.log"
  cat $folder/SHA256SUMS
}

# release VERSION|--dry-run [twice]: makes all files of a release from a clean clone of HEAD in build/release-VERSION/files.
# CHANGELOG.md decides the version. With `twice`, makes the files again in another folder, and compares all bytes.
release() {
  local version date folder
  read -r version date <<<"$(newest_version)"
  PACKAGES="git python3 abigail-tools"
  case "${1:-}${2:+ $2}" in
    --dry-run) install_missing && dry_run "$version"; return ;;
    "$version" | "$version twice") ;;
    *) fail "usage: ./do release --dry-run | $version [twice] (the newest version in CHANGELOG.md is $version)" ;;
  esac
  [ "$date" != unreleased ] || fail "CHANGELOG.md: expected the date of version $version, found 'unreleased'"
  [ -z "$(git status --porcelain)" ] || fail "expected a clean checkout, found changes that are not committed"
  install_missing
  step abi "comparing the ABI with the last release" toolchains/packaging/compare_abi.sh
  folder=build/release-$version
  make_release "$folder" "$version"
  cat "$folder/files/SHA256SUMS"
  [ "${2:-}" = twice ] || return 0
  make_release "$folder-again" "$version"
  diff "$folder/files/SHA256SUMS" "$folder-again/files/SHA256SUMS" || fail "two builds have different bytes"
  echo "both builds have the same bytes"
}
