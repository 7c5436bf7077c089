# SPDX-License-Identifier: Apache-2.0
# Recipe for Yocto. Set STARFOCUS_URI to the address of the repository or of a source archive.
SUMMARY = "Refocusing of sparse light fields"
LICENSE = "Apache-2.0"
LIC_FILES_CHKSUM = "file://LICENSE;md5=265a171ff913b24bcc5721d466c0a25a"
DEPENDS = "highway"
SRC_URI = "${STARFOCUS_URI}"
S = "${WORKDIR}/starfocus-${PV}"
inherit cmake pkgconfig
EXTRA_OECMAKE = "-DSTARFOCUS_PROGRAMS=OFF -DSTARFOCUS_TESTS=OFF"
