"""Sphinx settings for the pages of the Python package (`make docs`)."""

project = "dotpose"
extensions = ["sphinx.ext.autodoc"]
autodoc_member_order = "bysource"
html_theme = "alabaster"
