"""Search over the parameters of a document: what is tuned, how a run is judged, and by which algorithm."""
