"""The result as a picture: curve, key-frames and segments, as SVG or PNG; and what notebooks make of it.

layout    where everything stands
picture   what a picture is made of
data_frame  the result as a data frame
font      the font of the labels
svg, png  the picture as text and as pixels
matplotlib_figure  the result as a figure of matplotlib
notebook  the result as HTML
poses     a body in some of its frames
"""
