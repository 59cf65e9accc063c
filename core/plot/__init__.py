"""The result as a picture: curve, key-frames and segments, as SVG or PNG.

layout   where everything stands
picture  what a picture is made of
font     the font of the labels
svg, png the picture as text and as pixels
"""
