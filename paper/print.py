#!/usr/bin/python3
"""Sets the printed report by WeasyPrint:  print.py PAGE BASE_URL PDF

A table or picture that does not fit on the rest of a page would leave it white. WeasyPrint has no floats for pages. So,
as TeX does, the text that follows is moved in front of what does not fit, until the page is full. Tables and pictures
keep their order, and no heading is parted from its text.
"""

import gc
import logging
import sys

import weasyprint
from weasyprint.layout import page as page_layout

# Text moves up where more than this part of a page would stay white, the beginning of a chapter where more than this.
WHITE, WHITE_BEFORE_CHAPTER = 0.15, 0.25
# A page that is emptier than this is reported.
TOO_WHITE = 1 / 3


def names(box, *tags):
    return box.element_tag in tags


def floats(box):
    """Whether a block may be moved behind text: a table or picture with its caption."""
    return box.element is not None and not {"wide", "figure"}.isdisjoint((box.element.get("class") or "").split())


def is_heading(box):
    return names(box, "h1", "h2", "h3", "h4")


def text_after(blocks, first):
    """The range of blocks that may go before the float at `first`, and whether a chapter begins in it, or nothing."""
    begin = first
    while begin < len(blocks) and floats(blocks[begin]):
        begin += 1
    end = begin
    while end < len(blocks) and is_heading(blocks[end]):
        end += 1
    if end >= len(blocks) or floats(blocks[end]) or names(blocks[end], "nav"):
        return None
    return begin, end + 1, any(names(block, "h1") for block in blocks[begin:end])


def descend(box, resume_at):
    """The laid out or original box that holds the report's blocks, and where among them the next page begins."""
    while not names(box, "main"):
        ((index, resume_at),) = resume_at.items()
        box = box.children[index]
    ((index, inside),) = resume_at.items()
    return box, index, inside


def bottom_of(page):
    """Where the last block of a page ends."""
    box = page.children[0]
    while not names(box, "main"):
        box = box.children[-1]
    last = box.children[-1]
    return last.border_box_y() + last.border_height()


def white_part(page, context):
    return (context.page_bottom - bottom_of(page)) / page.height


def make_page(index, context, root_box, html):
    """Lays out a page, and moves text up to it as long as a float leaves it white."""
    page, resume_at = lay_out_page(index, context, root_box, html)
    while resume_at is not None:
        main, first, inside = descend(root_box, resume_at)
        blocks = list(main.children)
        while first < len(blocks) and is_heading(blocks[first]):
            first += 1
        if inside is not None or first == len(blocks) or not floats(blocks[first]):
            break
        text = text_after(blocks, first)
        if text is None or white_part(page, context) < (WHITE_BEFORE_CHAPTER if text[2] else WHITE):
            break
        begin, end, _ = text
        blocks[first:end] = blocks[begin:end] + blocks[first:begin]
        main.children = blocks
        # As WeasyPrint itself does before it makes a page again.
        context.page_maker[index][-1].update(content_changed=False, pages_wanted=False, anchors=[], content_lookups=[])
        page, resume_at = lay_out_page(index, context, root_box, html)
    white[index] = white_part(page, context)
    return page, resume_at


# The only function of WeasyPrint that is replaced; both must be there.
lay_out_page, page_layout.remake_page = page_layout.remake_page, make_page
white = {}

logger = logging.getLogger("weasyprint")
handler = logging.StreamHandler()
handler.setFormatter(logging.Formatter("%(levelname)s: %(message)s"))
logger.addHandler(handler)


def put_contents_after_abstract(main):
    """So the first page has the abstract and the picture that sums the report up."""
    contents = main.find("nav")
    chapters = main.findall("h1")
    if contents is not None and len(chapters) > 1:
        main.remove(contents)
        contents.set("class", "after-abstract")
        main.insert(list(main).index(chapters[1]), contents)


def set_report(source, base_url, target):
    html = weasyprint.HTML(source, base_url=base_url)
    put_contents_after_abstract(html.etree_element.find(".//main"))
    document = html.render()
    document.write_pdf(target)
    return document


# The boxes of the whole report stay until the end; to look for garbage among them takes as long as the layout.
gc.disable()
# Python 3.11 keeps the frames of calls in pieces of 16 KiB, and maps and unmaps such a piece at every call across its end,
# of which the layout of nested boxes has hundreds of thousands. A first frame of a megabyte gets a piece that has room for
# all others.
set_report.__code__ = set_report.__code__.replace(co_stacksize=1 << 17)
document = set_report(*sys.argv[1:])
for index in range(len(document.pages) - 1):
    if white[index] > TOO_WHITE:
        print(f"Page {index + 1} of the printed report is {100 * white[index]:.0f} percent empty.")
