#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# usage: aar.sh OUT.aar CLASSES.jar ABI=LIBRARY...
# Packs an Android archive (AAR) without Gradle. The AAR contains the Java classes, libstarfocus_jni.so for each ABI
# (arm64-v8a, x86_64), and a prefab package with the C headers and the libraries. C and C++ projects find the prefab
# package with find_package(starfocus CONFIG) and link starfocus::starfocus_jni. The script requires zip. The
# environment variable ANDROID_NDK_MAJOR is the major version of the NDK that built the libraries; default 27. The files
# in the archive have the time SOURCE_DATE_EPOCH (default: 1980), so that the archive depends on its contents only.
set -eu
[ $# -ge 3 ] || { echo "usage: $0 OUT.aar CLASSES.jar ABI=LIBRARY..." >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
out=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
classes=$2
shift 2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
version=$(sed -n 's/^#define STARFOCUS_VERSION_[A-Z]* \([0-9]*\)$/\1/p' "$here/../../lib/include/starfocus/version.h" |
  paste -s -d .)
least=$(sed -n 's/^ *minSdk \([0-9]*\).*/\1/p' "$here/build.gradle")

cp "$classes" "$work/classes.jar"
: >"$work/R.txt"
cat >"$work/AndroidManifest.xml" <<TEXT
<?xml version="1.0" encoding="utf-8"?>
<manifest xmlns:android="http://schemas.android.com/apk/res/android" package="dev.starfocus">
    <uses-sdk android:minSdkVersion="$least" />
</manifest>
TEXT
module=$work/prefab/modules/starfocus_jni
mkdir -p "$module/include"
printf '{"schema_version": 2, "name": "starfocus", "version": "%s", "dependencies": []}\n' \
  "$version" >"$work/prefab/prefab.json"
printf '{"export_libraries": [], "library_name": "libstarfocus_jni"}\n' >"$module/module.json"
cp -r "$here/../../lib/include/starfocus" "$here/../pool/include/starfocus" "$module/include"
for pair in "$@"; do
  abi=${pair%%=*}
  mkdir -p "$work/jni/$abi" "$module/libs/android.$abi"
  cp "${pair#*=}" "$work/jni/$abi/libstarfocus_jni.so"
  cp "${pair#*=}" "$module/libs/android.$abi/libstarfocus_jni.so"
  printf '{"abi": "%s", "api": %s, "ndk": %s, "stl": "none", "static": false}\n' \
    "$abi" "$least" "${ANDROID_NDK_MAJOR:-27}" >"$module/libs/android.$abi/abi.json"
done
rm -f "$out"
find "$work" -exec touch -d "@${SOURCE_DATE_EPOCH:-315532800}" {} +
(cd "$work" && find . ! -name . | LC_ALL=C sort | TZ=UTC zip -q -X -@ "$out")
