#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# run.sh BUILD [PRESET JRE]: tests the Java API with the library of BUILD. Runs the tests, and an example whose output
# must equal the output of the program. Tests the paths for Android with replacements for the NDK, and tests an AAR.
# With PRESET, tests the library that was built next to BUILD for aarch64, in an emulator with the Java runtime in the
# folder JRE.
set -eu
case $# in 1 | 3) ;; *) echo "usage: $0 BUILD [aarch64 JRE]" >&2; exit 2 ;; esac
sources=$(cd "$(dirname "$0")/../../.." && pwd)
build=$(cd "$1" && pwd)
preset=${2:-}
library=$build/lib/libstarfocus_jni.so
cc=cc cxx=c++
name=Java
java() { command java "$@"; }
if [ -n "$preset" ]; then
  name="Java, $preset"
  jre=$(cd "$3" && pwd)
  library=$(dirname "$build")/$preset/lib/libstarfocus_jni.so
  cc=aarch64-linux-gnu-gcc cxx=aarch64-linux-gnu-g++
  program=$(find "$jre/usr/lib/jvm" -path '*-17-*/bin/java')
  # Under emulation, compiling frequent code saves time, but the optimizing compiler takes too long.
  java() {
    qemu-aarch64 -L /usr/aarch64-linux-gnu \
      -E "LD_LIBRARY_PATH=$jre/usr/lib/aarch64-linux-gnu:$jre/lib/aarch64-linux-gnu" \
      "$program" -XX:TieredStopAtLevel=1 "$@"
  }
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
java_sources=$sources/platform/java/src

fail() {
  echo "$name: $1" >&2
  exit 1
}

# quietly COMMAND...: runs a command. Prints the output only if the command fails.
quietly() {
  "$@" >"$work/log" 2>&1 || { cat "$work/log" >&2; fail "failed: $*"; }
}

# run CLASS ARGUMENT...: runs a class, and prints the last line of the output, which is a summary.
run() {
  quietly java -Xcheck:jni -cp "$work/classes" "-Djava.library.path=$(dirname "$library")" "$@"
  ! grep -q 'WARNING\|FATAL' "$work/log" || { cat "$work/log" >&2; fail "misused JNI: $1"; }
  printf '%-40s %s\n' "$name" "$(tail -n 1 "$work/log")"
}

compile() {
  quietly javac -Xlint:all -Werror --release 11 -cp "$work/classes" -d "$work/classes" "$@"
}

# Checks that the segments of a library are aligned to pages of 16 KiB, as Android 15 requires.
page_alignment() {
  readelf -lW "$1" | awk '$1 == "LOAD" { ++n; if ($NF != "0x4000") bad = 1 } END { exit bad || n < 2 }' ||
    fail "$1 is not aligned to pages of 16 KiB: $(readelf -lW "$1" | grep LOAD)"
}

# The build uses android/bitmap.h from Debian. The folder android_double replaces headers that Debian does not have.
android_routes() {
  headers=$(find /usr/include/android -name bitmap.h 2>/dev/null | head -n 1)
  [ -n "$headers" ] || { echo "SKIPPED: Android's routes, for which there is no android/bitmap.h"; return; }
  javac=$(readlink -f "$(command -v javac)")
  jni=${javac%/bin/javac}/include
  double=$sources/tests/bindings/java/android_double
  quietly "$cxx" -std=c++17 -Wall -Wextra -Werror -fPIC -shared -o "$work/libdouble.so" \
    "-I$sources" "-I$sources/lib/include" "-I$double" "-isystem$jni" "-isystem$jni/linux" \
    "-isystem$(dirname "$(dirname "$headers")")" "$java_sources"/android/cpp/*.cc \
    "$java_sources/main/cpp/exceptions.cc" "$sources/platform/problem.cc" "$double/android_double.cc" \
    "$library"
  compile "$double"/android/*/*.java "$java_sources"/android/java/dev/starfocus/android/*.java \
    "$sources/tests/bindings/java/AndroidTest.java"
  run AndroidTest "$work/libdouble.so"
}

# phone PROGRAM...: runs a program of examples/phone with the frame and the taps below. Writes one picture for each tap.
phone() {
  for tap in 10 100; do
    quietly "$@" "$work/frame" "$work/depth" 128 64 $tap 32 "$work/$tap.nv12"
  done
}

# Compiles tap to focus in Kotlin against the classes of the AAR, and compares its pictures with those of the C program.
kotlin() {
  command -v kotlinc >/dev/null || { echo "SKIPPED: Kotlin, because kotlinc is not installed"; return; }
  python3 - "$work/frame" "$work/depth" <<'TEXT'
import array, sys
with open(sys.argv[1], "wb") as frame:
    frame.write(bytes(40 + 7 * (x * y % 23) for y in range(64) for x in range(128)) + bytes([120, 140]) * 2048)
with open(sys.argv[2], "wb") as depth:
    depth.write(array.array("H", [0 if x == 9 else 4000 if x < 16 else 500 for y in range(16) for x in range(32)]))
TEXT
  quietly kotlinc "$sources/examples/phone/TapToFocus.kt" -cp "$work/classes.jar" -include-runtime -d "$work/tap.jar"
  phone java -Xcheck:jni -cp "$work/tap.jar:$work/classes.jar" "-Djava.library.path=$(dirname "$library")" TapToFocusKt
  mv "$work/10.nv12" "$work/far" && mv "$work/100.nv12" "$work/near"
  phone "$build/phone"
  cmp "$work/far" "$work/10.nv12" && cmp "$work/near" "$work/100.nv12" || fail "Kotlin's pictures are not those of C"
  ! cmp -s "$work/far" "$work/near" || fail "the pictures of two taps are equal"
  printf '%-40s %s\n' "$name" "tap to focus in Kotlin: the bytes of C"
}

# Checks the parts of the AAR that Gradle and prefab require.
archive() {
  case "$preset" in aarch64) abi=arm64-v8a ;; *) abi=x86_64 ;; esac
  quietly jar cf "$work/classes.jar" -C "$work/classes" dev/starfocus
  quietly "$sources/platform/java/aar.sh" "$work/starfocus.aar" "$work/classes.jar" "$abi=$library"
  quietly "$sources/platform/java/aar.sh" "$work/again.aar" "$work/classes.jar" "$abi=$library"
  cmp "$work/starfocus.aar" "$work/again.aar" || fail "two archives of the same files differ"
  mkdir "$work/aar"
  (cd "$work/aar" && quietly jar xf "$work/starfocus.aar")
  module=prefab/modules/starfocus_jni
  for part in AndroidManifest.xml classes.jar R.txt jni/$abi/libstarfocus_jni.so prefab/prefab.json \
    $module/module.json $module/libs/android.$abi/abi.json \
    $module/libs/android.$abi/libstarfocus_jni.so $module/include/starfocus/starfocus.h \
    $module/include/starfocus/pool.h; do
    [ -s "$work/aar/$part" ] || [ $part = R.txt ] || fail "the AAR lacks $part"
  done
  for part in $(cd "$work/aar" && find prefab -name '*.json'); do
    quietly python3 -m json.tool "$work/aar/$part"
  done
  page_alignment "$work/aar/jni/$abi/libstarfocus_jni.so"
  # C programs can link the libraries in the archive.
  cat >"$work/linked.c" <<'TEXT'
#include <starfocus/starfocus.h>
#include <starfocus/pool.h>
int main(void) {
  uint32_t abi = 0;
  return starfocus_pool_cores() == 0 || !starfocus_version(&abi) || abi != STARFOCUS_ABI;
}
TEXT
  quietly "$cc" "-I$work/aar/$module/include" -o "$work/linked" "$work/linked.c" \
    "$work/aar/jni/$abi/libstarfocus_jni.so" -Wl,--unresolved-symbols=ignore-in-shared-libs
  printf '%-40s %s\n' "$name" "an AAR with prefab, pages of 16 KiB"
}

page_alignment "$library"
mkdir "$work/classes"
compile "$java_sources"/main/java/dev/starfocus/*.java
compile "$sources/examples/java/Refocus.java" "$sources/tests/bindings/java/RefocuserTest.java"
run dev.starfocus.RefocuserTest
quietly "$build/starfocus-lab" scene "$work/scene" --name portrait --size 320x240 --views 5
for focus in -2.5 1.5; do
  quietly "$build/starfocus" refocus "$work/scene" --focus $focus -o "$work/expected.ppm"
  run Refocus "$work/scene" $focus "$work/found.ppm"
  cmp "$work/found.ppm" "$work/expected.ppm" || fail "the bytes at focus $focus are not the program's"
  printf '%-40s %s\n' "$name" "the program's bytes at focus $focus"
done
rm "$work"/classes/dev/starfocus/*Test*
archive
[ -n "$preset" ] || kotlin
android_routes
