"""A browser that prints an empty page: what is done with a print is tested without a real one."""

import pikepdf


def browser(folder, line='cp "$empty" "$pdf"'):
    """Return the path of a browser whose print is made by one shell line; by default a page."""
    folder.mkdir(exist_ok=True)
    empty, path = folder / "empty.pdf", folder / "chromium"
    with pikepdf.new() as file:
        file.add_blank_page()
        file.docinfo["/CreationDate"] = "D:20010203040506Z"
        file.save(empty)
    find = "for word; do case $word in --print-to-pdf=*) pdf=${word#*=};; esac; done\n"
    path.write_text(f"#!/bin/sh\nempty={empty}\n{find}{line}\n", encoding="utf-8")
    path.chmod(0o755)
    return path
