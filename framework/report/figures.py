def write(folder, compared):
    pass
