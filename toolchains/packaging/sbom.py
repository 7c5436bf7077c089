# SPDX-License-Identifier: Apache-2.0
"""Writes the parts of a release in the format SPDX 2.3 (JSON).

usage: sbom.py FOLDER VERSION REVISION

Lists the files in FOLDER with their checksums, and the libraries in the table of docs/developing.md with the licences
there and the versions of this machine's Debian packages. The environment variable SOURCE_DATE_EPOCH is the time of the
document; without it, the time is the time of the commit REVISION.
"""
import hashlib
import json
import os
import re
import subprocess
import sys
from datetime import datetime, timezone
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# Licences of docs/developing.md as SPDX identifiers.
LICENCES = {
    "Apache-2.0": "Apache-2.0",
    'public domain, or MIT ("Expat")': "LicenseRef-public-domain OR MIT",
    "BSD-3-Clause, IJG, Zlib": "BSD-3-Clause AND IJG AND Zlib",
    "libpng": "libpng-2.0",
    'MIT ("Expat")': "MIT",
    "MIT": "MIT",
    "BSD-3-Clause": "BSD-3-Clause",
    "libtiff": "libtiff",
    "LGPL-3-or-later": "LGPL-3.0-or-later",
    "LGPL-2.1-or-later": "LGPL-2.1-or-later",
    "LGPL-2.1": "LGPL-2.1-only",
}

# Debian packages of the libraries in docs/developing.md.
PACKAGES = {
    "Highway": "libhwy-dev", "stb_image, stb_image_write": "libstb-dev", "libjpeg-turbo": "libjpeg62-turbo-dev",
    "libpng": "libpng-dev", "libdeflate": "libdeflate-dev", "libwebp": "libwebp-dev", "libsixel": "libsixel-dev",
    "libtiff": "libtiff-dev", "OpenEXR": "libopenexr-dev", "libheif": "libheif-dev", "libexif": "libexif-dev", "Expat": "libexpat1-dev",
    "libseccomp": "libseccomp-dev", "CLI11": "libcli11-dev", "nlohmann-json": "nlohmann-json3-dev",
    "libgpiod": "libgpiod-dev", "GStreamer": "libgstreamer-plugins-base1.0-dev",
    "doctest": "doctest-dev", "Google Benchmark": "libbenchmark-dev",
}


def run(*command: str) -> str:
    """Returns the output of a command, or '' if the command fails."""
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False).stdout.strip()


def libraries():
    """Yields name, home page, licence and users of each library in docs/developing.md."""
    text = (ROOT / "docs/developing.md").read_text(encoding="utf-8")
    row = r"^\| \[([^\]]+)\]\(([^)]+)\)[^|]*\| ([^|]+) \| ([^|]+) \|"
    for name, page, licence, users in re.findall(row, text, re.MULTILINE):
        yield name, page, LICENCES[licence.strip()], users


def identifier(name: str) -> str:
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]+", "-", name)


def package_of(name: str, version: str, licence: str, page: str) -> dict:
    package = {"SPDXID": identifier(name), "name": name, "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
               "licenseConcluded": licence, "licenseDeclared": licence, "copyrightText": "NOASSERTION"}
    if version:
        package["versionInfo"] = version
    if page:
        package["homepage"] = page
    return package


def file_of(folder: Path, path: Path) -> dict:
    content = path.read_bytes()
    name = path.relative_to(folder).as_posix()
    checksums = [{"algorithm": name, "checksumValue": hashlib.new(name.lower(), content).hexdigest()}
                 for name in ("SHA1", "SHA256")]
    return {"SPDXID": identifier("file-" + name), "fileName": "./" + name, "checksums": checksums,
            "licenseConcluded": "NOASSERTION", "copyrightText": "NOASSERTION"}


def document(folder: Path, version: str, revision: str) -> dict:
    epoch = os.environ.get("SOURCE_DATE_EPOCH") or run("git", "log", "-1", "--format=%ct", revision)
    packages = [package_of("starfocus", version, "Apache-2.0", "")]
    ours = packages[0]["SPDXID"]
    related = [("SPDXRef-DOCUMENT", "DESCRIBES", ours)]
    for name, page, licence, users in libraries():
        installed = run("dpkg-query", "-W", "-f", "${Version}", PACKAGES[name])
        packages.append(package_of(name, installed, licence, page))
        for_tests = users.startswith(("the tests", "`starfocus-bench"))
        library = packages[-1]["SPDXID"]
        related.append((library, "TEST_DEPENDENCY_OF", ours) if for_tests else (ours, "DEPENDS_ON", library))
    files = [file_of(folder, path) for path in sorted(folder.rglob("*")) if path.is_file()]
    related += [(file["SPDXID"], "GENERATED_FROM", ours) for file in files]
    return {
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"starfocus-{version}",
        "documentNamespace": f"https://spdx.org/spdxdocs/starfocus-{version}-{revision}",
        "creationInfo": {
            "created": datetime.fromtimestamp(int(epoch), timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
            "creators": ["Organization: The starfocus authors", "Tool: toolchains/packaging/sbom.py"]},
        "hasExtractedLicensingInfos": [{
            "licenseId": "LicenseRef-public-domain", "name": "public domain",
            "extractedText": "The authors of stb_image place the code in the public domain."}],
        "packages": packages, "files": files,
        "relationships": [{"spdxElementId": a, "relationshipType": kind, "relatedSpdxElement": b}
                          for a, kind, b in related],
    }


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit("usage: sbom.py FOLDER VERSION REVISION")
    json.dump(document(Path(sys.argv[1]), *sys.argv[2:]), sys.stdout, indent=1)
    print()
