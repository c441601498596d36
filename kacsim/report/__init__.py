"""The report: the page and its numbers, on paper, as tables, and the copy that is kept."""
