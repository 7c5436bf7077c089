// swift-tools-version:5.5
// SPDX-License-Identifier: Apache-2.0
// Provides the C headers of an installed starfocus as the Swift module CStarfocus, and links the library
// that pkg-config finds. This manifest of the Swift package is untested. The command `./do
// consumers swift` compiles the module map with clang.
import PackageDescription

let package = Package(
    name: "starfocus",
    products: [.library(name: "CStarfocus", targets: ["CStarfocus"])],
    targets: [
        .systemLibrary(name: "CStarfocus", path: "Sources/CStarfocus", pkgConfig: "starfocus")
    ]
)
