# kerrd in a Jupyter server, by jupyter-server-proxy: JupyterLab's launcher has it, and its page is at …/kerrd/. It
# starts at the first visit and stops with Jupyter. Put this file into ~/.jupyter/. If browsers reach the hub by another
# name than this machine's, add '--host', 'NAME' with that name.
c.ServerProxy.servers = {  # noqa: F821: Jupyter defines c
    "kerrd": {
        "command": ["kerrd", "serve", "--port", "{port}", "--client-share", "100"],
        "timeout": 60,  # a first start may have kernels to compile
        "new_browser_tab": True,  # its page does not let itself be framed
        "launcher_entry": {"title": "kerrd"},
    }
}
