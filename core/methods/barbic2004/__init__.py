"""Compared with: segments whose poses lie near one hyperplane, or in one Gaussian (the paper's [3]).

pca   a cut where the error of a projection rises
ppca  a cut where the frames ahead leave the distribution of those behind
gmm   a cut where frames pass from one Gaussian of a mixture to another

Barbič, Safonova, Pan, Faloutsos, Hodgins and Pollard, "Segmenting motion capture data into distinct behaviors",
Graphics Interface 2004. Their numbers of frames, at 120 a second, are seconds here.
"""
