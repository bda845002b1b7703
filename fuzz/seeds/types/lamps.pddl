(:types room lamp - object hall - room)
