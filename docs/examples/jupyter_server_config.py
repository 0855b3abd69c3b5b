# Runs kerrd in a Jupyter server by jupyter-server-proxy. JupyterLab's launcher has an entry for it, and its page is at
# …/kerrd/. The server starts at the first visit and stops with Jupyter. Put this file into ~/.jupyter/. If browsers
# reach the hub by a name other than this machine's, add '--host', 'NAME' with that name.
c.ServerProxy.servers = {  # noqa: F821: Jupyter defines c
    "kerrd": {
        "command": ["kerrd", "serve", "--port", "{port}", "--client-share", "100"],
        "timeout": 60,  # the first start may have to compile kernels
        "new_browser_tab": True,  # the page forbids being shown in a frame
        "launcher_entry": {"title": "kerrd"},
    }
}
