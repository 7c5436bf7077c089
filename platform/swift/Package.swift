// swift-tools-version:5.5
// SPDX-License-Identifier: Apache-2.0
// The C headers of an installed starfocus as the Swift module CStarfocus, with the library that pkg-config
// knows. The manifest is untested: there was no Swift where this was written; the module map is compiled
// by clang in ./do consumers swift.
import PackageDescription

let package = Package(
    name: "starfocus",
    products: [.library(name: "CStarfocus", targets: ["CStarfocus"])],
    targets: [
        .systemLibrary(name: "CStarfocus", path: "Sources/CStarfocus", pkgConfig: "starfocus")
    ]
)
