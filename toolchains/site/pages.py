# SPDX-License-Identifier: Apache-2.0
"""Renders the documents of the project as a static site.

usage: pages.py SITE GALLERY

Writes README.md, docs/*.md, gallery.md and all Markdown files that they link to as HTML pages into the folder SITE, in
the folders of the documents; gallery.html is beside index.html. Copies linked pictures. Copies linked source files as
text: `X` becomes `X.txt`. GALLERY is the folder that gallery.py wrote.
"""

import html
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unicodedata

PICTURES = {'.png', '.jpg', '.svg'}
HOME = 'README.md'
GALLERY = 'toolchains/site/gallery.md'


def target(document):
    """Returns the path of the page of a document in the site."""
    return {HOME: 'index.html', GALLERY: 'gallery.html'}.get(document, document[:-len('.md')] + '.html')


def relative(path, page):
    """Returns the link from a page to a path of the site."""
    return os.path.relpath(path, os.path.dirname(page) or '.')


def slug(heading):
    """Returns the anchor that GitHub gives to a heading."""
    text = html.unescape(re.sub(r'<[^>]*>', '', heading)).lower()
    kept = (c for c in text if c in ' -_' or unicodedata.category(c)[0] in 'LN')
    return ''.join(kept).replace(' ', '-')


def add_anchors(body):
    used = {}

    def heading(match):
        level, text = match.groups()
        name = slug(text)
        count = used[name] = used.get(name, -1) + 1
        name += f'-{count}' if count else ''
        link = '' if level == '1' else f'<a class="anchor" href="#{name}" aria-label="Link to this section">#</a>'
        return f'<h{level} id="{name}">{text}{link}</h{level}>'

    return re.sub(r'<h([1-6])>(.*?)</h\1>', heading, body)


class Site:
    def __init__(self, folder, gallery):
        self.folder = pathlib.Path(folder)
        self.gallery = pathlib.Path(gallery)
        self.documents = [HOME, GALLERY] + sorted(str(path) for path in pathlib.Path('docs').glob('*.md'))
        self.groups = groups_of(pathlib.Path(HOME).read_text())

    def copy(self, source, path):
        destination = self.folder / path
        destination.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, destination)

    def link(self, document, link):
        """Returns the link of a page for a link of its document, and adds the linked file to the site."""
        if re.match(r'[a-z]+:', link) or link.startswith('#'):
            return link
        path, _, fragment = link.partition('#')
        path = os.path.normpath(os.path.join(os.path.dirname(document), path))
        if path.endswith('.md'):
            if path not in self.documents:
                self.documents.append(path)
            path = target(path)
        elif pathlib.Path(path).suffix in PICTURES:
            self.copy(path, path)
        else:
            self.copy(path, path + '.txt')
            path += '.txt'
        return relative(path, target(document)) + ('#' + fragment if fragment else '')

    def body(self, document):
        command = ['cmark-gfm', '--extension', 'table', '--extension', 'strikethrough', document]
        body = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        body = re.sub(r'(href|src)="([^"]*)"', lambda m: f'{m[1]}="{self.link(document, m[2])}"', body)
        body = re.sub(r'>(?:[\w-]+/)*([\w-]+)\.md</a>', r'>\1</a>', body)
        body = add_anchors(body).replace('<table>', '<div class="wide"><table>')
        return body.replace('</table>', '</table></div>').replace('<pre>', '<pre tabindex="0">')

    def navigation(self, document):
        parts = []
        for name, links in self.groups:
            parts.append(f'<h2>{html.escape(name.capitalize())}</h2>\n<ul>')
            for title, link in links:
                current = ' aria-current="page"' if link == document else ''
                parts.append(f'<li><a href="{self.link(document, relative(link, document))}"{current}>'
                             f'{html.escape(title)}</a></li>')
            parts.append('</ul>')
        return '\n'.join(parts)

    def page(self, document, body, head='', tail=''):
        page = target(document)
        title = html.unescape(re.sub(r'<[^>]*>', '', re.search(r'<h1[^>]*>(.*?)</h1>', body).group(1)))
        title = title if document == HOME else title + ' – starfocus'
        top = [('starfocus', 'index.html'), ('Gallery', target(GALLERY)), ('Try it', 'tap/index.html'),
               ('Program', 'docs/program.html'), ('Library', 'docs/library.html'), ('C reference', 'reference/files.html')]
        links = '\n'.join('<a href="{}"{}>{}</a>'.format(relative(path, page),
                                                         ' aria-current="page"' if path == page else '', name)
                          for name, path in top)
        return f'''<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>{html.escape(title)}</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<link rel="stylesheet" href="{relative('site.css', page)}">
{head}</head>
<body>
<header>
{links}
<a class="to-pages" href="#pages">All pages</a>
</header>
<div id="layout">
<main>
{body}</main>
<nav id="pages" aria-label="All pages">
{self.navigation(document)}
</nav>
</div>
{tail}</body>
</html>
'''

    def add_sliders(self, body):
        """Adds the pictures to the gallery, before the commands that made them."""

        def pictures(match):
            name = re.search(r'--compare (\w+)\.html', match.group()).group(1)
            found = [f'{name}-before.jpg', f'{name}-after.jpg', f'{name}.html']
            slider = (self.gallery / f'{name}.slider').read_text()
            for movie in re.findall(r'-o (\w+\.webp)', match.group()):
                found.append(movie)
                slider += f'<p><img loading="lazy" src="gallery/{movie}" alt="Animation of the focus"></p>\n'
            for file in found:
                self.copy(self.gallery / file, f'gallery/{file}')
            return f'{slider}<p><a href="gallery/{name}.html">Depth and pixels in focus</a></p>\n{match.group()}'

        return re.sub(r'<pre[^>]*><code>.*?</code></pre>', pictures, body, flags=re.S)

    def write(self):
        self.copy(pathlib.Path(__file__).with_name('site.css'), 'site.css')
        for document in self.documents:  # link() appends linked documents
            body, head, tail = self.body(document), '', ''
            if document == GALLERY:
                body = self.add_sliders(body)
                for file in ('slider.css', 'slider.js'):
                    self.copy(self.gallery / file, f'gallery/{file}')
                head = '<link rel="stylesheet" href="gallery/slider.css">\n'
                tail = '<script src="gallery/slider.js"></script>\n'
            path = self.folder / target(document)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(self.page(document, body, head, tail))
        print(f'{len(self.documents)} pages')


def groups_of(readme):
    """Returns the rows of the table of documents in the README: (name, [(title, document), ...])."""
    rows = re.search(r'^\| for \| page \|\n.*?\n((?:\|.*\n)+)', readme, re.M).group(1)
    return [(row.split('|')[1].strip(), re.findall(r'\[([^\]]+)\]\(([^)]+)\)', row)) for row in rows.splitlines()]


if __name__ == '__main__':
    Site(*sys.argv[1:]).write()
