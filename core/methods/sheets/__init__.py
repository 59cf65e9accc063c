"""Sheets: a timeline of clips laid end to end, each performed once, as artists and packs of clips keep them.

method       the part of the default method that cuts a sheet
recognition  whether a take is a sheet, and why
division     the best division of a sheet into clips
"""
