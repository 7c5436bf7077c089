# SPDX-License-Identifier: Apache-2.0
"""Checks the links of a static site.

usage: links.py SITE

Every link to a file of the site must be relative, and the file and the anchor must exist. Pages must not load anything
from other sites. Prints all links to other sites. The exit code is 1 if a link is broken.
"""

import html.parser
import pathlib
import re
import sys
import urllib.parse

LINKS = {'href', 'src', 'poster', 'data'}


class Page(html.parser.HTMLParser):
    """Collects the anchors and links of a page. A link is (URL, True if the browser loads the URL)."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.links = set(), []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == 'id' or (tag == 'a' and name == 'name'):
                self.anchors.add(value)
            elif name in LINKS and value:
                self.links.append((value, tag != 'a' and tag != 'area'))


def read_site(folder):
    """Returns the pages of a site, by path, and the links of style sheets."""
    pages = {path: Page(path.read_text()) for path in sorted(folder.rglob('*.html'))}
    for path in sorted(folder.rglob('*.css')):
        pages[path] = page = Page('')
        page.links = [(link.strip('\'" '), True) for link in re.findall(r'url\(([^)]*)\)', path.read_text())]
    return pages


def problem_of(path, link, loaded, pages, folder):
    """Returns what is wrong with a link of a page, or None."""
    parts = urllib.parse.urlsplit(link)
    if parts.netloc:
        return 'loads from another site' if loaded else None
    if parts.scheme:  # data: and, in pages of doxygen, javascript:
        return None
    if link.startswith('/'):
        return 'is not relative'
    target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
    if target.is_dir():
        target /= 'index.html'
    if folder not in target.parents:
        return 'leaves the site'
    if not target.is_file():
        return 'names a file that does not exist'
    anchor = urllib.parse.unquote(parts.fragment)
    if anchor and target in pages and anchor not in pages[target].anchors:
        return 'names an anchor that does not exist'
    return None


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    pages = read_site(folder)
    problems, others, count = [], set(), 0
    for path, page in pages.items():
        for link, loaded in page.links:
            count += 1
            problem = problem_of(path, link, loaded, pages, folder)
            if problem:
                problems.append(f'{path.relative_to(folder)}: {link} {problem}')
            elif re.match('https?:', link):
                others.add(link)
    print('\n'.join(['links to other sites, not checked:', *sorted(others)]))
    print('\n'.join(problems), file=sys.stderr)
    print(f'{count} links in {len(pages)} pages and style sheets, {len(problems)} broken')
    sys.exit(bool(problems) or not count)


main()
